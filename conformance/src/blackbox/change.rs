//! How right answers are changed on any wire. Places are in units of 1/65,536 of their number.

use super::probe::Damage;
use super::talk::Exchange;

/// A change of what answers a call.
#[derive(Clone, Debug)]
pub(super) enum Change {
    /// It comes in pieces.
    Pieces(Vec<u16>),
    /// There are other bytes before one.
    Noise(u16, Vec<u8>),
    Damage(u16, Vec<Damage>),
    Late,
    Silence,
    /// One comes twice.
    Twice(u16),
    Missing(u16),
    Swapped(u16),
}

impl Change {
    pub(super) fn happen(self, exchange: &mut Exchange) {
        let Exchange { played, cuts, is_late, .. } = exchange;
        let place = |at: u16| usize::from(at) * played.len() / 65_536;
        match self {
            Self::Pieces(places) => *cuts = places,
            Self::Late => *is_late = true,
            Self::Silence => played.clear(),
            Self::Noise(at, noise) => {
                let at = place(at);
                played.iter_mut().skip(at).take(1).for_each(|part| part.noise.clone_from(&noise));
            }
            Self::Damage(at, damage) => {
                let at = place(at);
                played.iter_mut().skip(at).take(1).for_each(|part| part.damage.clone_from(&damage));
            }
            Self::Twice(at) => {
                let again: Vec<_> = played.iter().skip(place(at)).take(1).cloned().collect();
                played.extend(again);
            }
            Self::Missing(at) => {
                let at = place(at);
                played.drain(at..(at + 1).min(played.len()));
            }
            Self::Swapped(at) => {
                let at = place(at);
                if at + 1 < played.len() {
                    played.swap(at, at + 1);
                }
            }
        }
    }
}
