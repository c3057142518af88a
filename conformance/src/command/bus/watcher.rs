//! Explains what passes on the line.

use std::collections::BTreeMap;
use std::io::{self, Write};
use std::ops::ControlFlow;
use std::time::Duration;

use actucheck::adapter::Wire;
use actucheck::bus::{QUIET, VirtualBus};
use actucheck::device::Tables;
use actucheck::explain::stream::{Event, Follower, Heard, Skipped};
use actucheck::link::{Port, Watch};
use actucheck_spec::wire::{Context, Direction};

use super::super::shared::Failure;
use super::super::shared::stream::{Sink as _, Text, Told};
use super::view::View;

/// Hands on what passes, as packets.
pub(super) struct Watcher {
    follower: Follower,
    told: Told,
    wrong: Option<Wrong>,
    view: Option<View>,
    /// When bytes passed last.
    last: Duration,
}

impl Watcher {
    /// Tells everything, and besides at once what is `wrong`, and shows the devices. `None` for a wire whose streams are not
    /// followed.
    pub(super) fn new(
        wire: Wire,
        tables: Tables,
        told: Told,
        wrong: Option<Wrong>,
        view: Option<View>,
    ) -> Option<Self> {
        let follower = Follower::new(wire, tables)?;
        Some(Self { follower, told, wrong, view, last: Duration::ZERO })
    }

    pub(super) fn begin(&mut self, ports: &[Port]) {
        self.told.write(|sink| sink.begin(None));
        for Port { kind, address, link } in ports {
            self.told.write(|sink| sink.port(kind, address, link.as_deref()));
        }
    }

    pub(super) fn end(mut self, lost: u64) -> Result<(), Failure> {
        self.follow(|follower, take| follower.end(take));
        if let Some(view) = &mut self.view {
            view.erase();
        }
        self.told.end()?;
        if lost > 0 {
            let s = if lost == 1 { "" } else { "s" };
            anstream::eprintln!("lost: {lost} byte{s} that no host took");
        }
        Ok(())
    }

    fn follow(&mut self, act: impl FnOnce(&mut Follower, &mut dyn FnMut(Event<'_>))) {
        let Self { follower, told, wrong, view, .. } = self;
        act(follower, &mut |event| {
            told.event(&event);
            if let Some(wrong) = wrong
                && wrong.is_news(&event)
            {
                if let Some(view) = view {
                    view.erase();
                }
                wrong.tell(&event);
            }
        });
    }
}

impl Watch for Watcher {
    fn passed(&mut self, direction: Direction, bytes: &[u8], at: Duration) {
        if at.saturating_sub(self.last) > QUIET {
            self.quiet();
        }
        self.last = at;
        self.follow(|follower, take| {
            follower.feed(bytes, Some(direction), None, Some(at), take);
        });
    }

    fn quiet(&mut self) {
        self.follow(|follower, take| follower.pause(take));
    }

    fn settled(
        &mut self,
        bus: &mut VirtualBus,
        now: Duration,
    ) -> ControlFlow<(), Option<Duration>> {
        self.told.write(|sink| sink.flush());
        if self.told.written.is_err() {
            return ControlFlow::Break(());
        }
        if let Some(view) = self.view.as_mut().filter(|view| view.next() <= now) {
            view.show(&bus.devices(now), self.told.summary.total(), now);
        }
        ControlFlow::Continue(self.view.as_ref().map(View::next))
    }
}

/// How often something is told before it is only counted.
const TOLD: u32 = 3;
/// Things that are kept apart.
const KINDS: usize = 64;

/// Tells what is wrong in what passes.
pub(super) struct Wrong {
    out: Text<Box<dyn Write>>,
    /// How often each was told: requirements, and reasons of bytes that are no packet.
    told: BTreeMap<String, u32>,
}

impl Wrong {
    pub(super) const fn new(out: Text<Box<dyn Write>>) -> Self {
        Self { out, told: BTreeMap::new() }
    }

    fn is_news(&mut self, event: &Event<'_>) -> bool {
        let kinds: Vec<_> = match event {
            // What devices send is wrong where the user wants it to be.
            Event::Packet(Heard { direction: Some(Direction::Reply), .. }, _)
            | Event::Skipped(Skipped {
                context: Context { direction: Some(Direction::Reply), .. },
                ..
            })
            | Event::Silent(_) => Vec::new(),
            Event::Packet(_, turn) => {
                turn.warnings.iter().map(|warning| warning.requirement).collect()
            }
            Event::Skipped(skipped) => skipped.reason.split(": ").take(1).collect(),
        };
        // All of them are counted.
        kinds.iter().filter(|kind| self.is_new(kind)).count() > 0
    }

    fn tell(&mut self, event: &Event<'_>) {
        // Nobody is left to be told that nobody can be told.
        let _: io::Result<()> = self.out.event(event);
    }

    fn is_new(&mut self, kind: &str) -> bool {
        if !self.told.contains_key(kind) && self.told.len() >= KINDS {
            return false;
        }
        let told = self.told.entry(kind.to_owned()).or_default();
        *told += 1;
        *told <= TOLD
    }
}
