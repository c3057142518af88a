//! Conversations of a host, in parts that can be generated and made smaller.

use actucheck_spec::wire::Packet;

use super::probe::{Part, cut, joined};
use super::wire;
use crate::adapter::{Burst, Called, Step};
use crate::bus::has_datagrams;
use crate::shrink::{Shrink, one_smaller};

/// The pause between two pieces of an answer, which is much shorter than any time-out.
const PAUSE_MS: u32 = 3;

/// Calls of a host, of which the last one is judged.
#[derive(Clone, Debug)]
pub(super) struct Talk {
    pub(super) exchanges: Vec<Exchange>,
    /// Whether it is judged what the last call sends, and not what it returns.
    pub(super) is_about_sent: bool,
}

/// A call of a host, and what the line plays to it.
#[derive(Clone, Debug)]
pub(super) struct Exchange {
    /// What the call sends.
    pub(super) packet: Packet,
    pub(super) played: Vec<Part>,
    /// Where that is cut into pieces with pauses, in units of 1/65,536 of its length.
    pub(super) cuts: Vec<u16>,
    /// Whether it comes only when the call has returned.
    pub(super) is_late: bool,
}

impl Talk {
    /// What each call sends and returns, from the first one on.
    pub(super) fn beginnings(&self) -> impl Iterator<Item = Self> {
        (1..=self.exchanges.len()).flat_map(|calls| {
            let exchanges: Vec<_> = self.exchanges.iter().take(calls).cloned().collect();
            [true, false].map(|is_about_sent| Self { exchanges: exchanges.clone(), is_about_sent })
        })
    }
}

impl Exchange {
    /// All that comes.
    pub(super) fn all(&self) -> Option<Vec<u8>> {
        joined(&self.played)
    }

    /// What comes while the call waits for it.
    pub(super) fn in_time(&self) -> Option<Vec<u8>> {
        if self.is_late { Some(Vec::new()) } else { self.all() }
    }

    /// What comes while the call waits for it, each part a datagram.
    pub(super) fn datagrams(&self) -> Option<Vec<Vec<u8>>> {
        let parts = if self.is_late { &[][..] } else { self.played.as_slice() };
        let all: Vec<_> =
            parts.iter().map(|part| joined(std::slice::from_ref(part))).collect::<Option<_>>()?;
        // An empty one is nothing on the line.
        Some(all.into_iter().filter(|datagram| !datagram.is_empty()).collect())
    }

    /// The step of the conversation. A host that is sure to wait for all of it gets it in pieces: else
    /// the rest could come in the next call. If it asks again, it gets something else.
    pub(super) fn step(&self, is_awaited: bool, again: Vec<u8>) -> Option<Step> {
        let late = if self.is_late { self.all()? } else { Vec::new() };
        let cuts = if is_awaited { self.cuts.as_slice() } else { &[] };
        let pieces = if has_datagrams(self.packet.wire()) {
            self.datagrams()?.into_iter().map(Into::into).collect()
        } else {
            cut(&self.in_time()?, cuts)
        };
        let pieces = pieces.into_iter().filter(|piece| !piece.is_empty());
        let times = (0..).map(|place| place * PAUSE_MS);
        let first: Vec<_> =
            pieces.zip(times).map(|(bytes, after_ms)| Burst { after_ms, bytes }).collect();
        let again = Some(Burst { after_ms: 0, bytes: again.into() });
        let again: Vec<_> = again.into_iter().filter(|burst| !burst.bytes.is_empty()).collect();
        let is_silent = first.is_empty() && again.is_empty();
        let answers = if is_silent { Vec::new() } else { vec![first, again.clone(), again] };
        Some(Step {
            packet: Called::from(self.packet.clone()),
            answers,
            late: late.into(),
            hurries: false,
        })
    }
}

impl Shrink for Talk {
    fn smaller(&self) -> Box<dyn Iterator<Item = Self> + '_> {
        let fewer = self.exchanges.smaller().map(|exchanges| Self { exchanges, ..self.clone() });
        let inside =
            one_smaller(&self.exchanges).map(|exchanges| Self { exchanges, ..self.clone() });
        Box::new(fewer.chain(inside))
    }
}

impl Shrink for Exchange {
    fn smaller(&self) -> Box<dyn Iterator<Item = Self> + '_> {
        let sooner = self.is_late.then(|| Self { is_late: false, ..self.clone() });
        let own = wire::of(self.packet.wire()).and_then(|probes| probes.host);
        let plainer = own.map(|host| (host.smaller)(self)).unwrap_or_default();
        let whole = self.cuts.smaller().map(|cuts| Self { cuts, ..self.clone() });
        let less = self.played.smaller().map(|played| Self { played, ..self.clone() });
        let inside = one_smaller(&self.played).map(|played| Self { played, ..self.clone() });
        Box::new(sooner.into_iter().chain(less).chain(whole).chain(plainer).chain(inside))
    }
}
