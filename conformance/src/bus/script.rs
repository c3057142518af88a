//! A line on which nothing answers but a script.

use std::mem;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use super::answers::{Answers, Bursts};
use super::fault::Alarm;
use super::{Chunk, DeviceState, Devices};

/// A script for a line. Its clones are one script: who writes it need not be where the line is.
#[derive(Clone, Debug, Default)]
pub(crate) struct Script(Arc<Mutex<Scene>>);

#[derive(Debug, Default)]
struct Scene {
    answers: Answers,
    has_come: bool,
    /// Whether what has come is recorded too.
    is_heard: bool,
    /// What else is answered.
    greetings: Greetings,
    /// What comes without being asked.
    unasked: Vec<u8>,
    /// How many bytes are on their way.
    coming: usize,
}

impl Script {
    /// Answers this packet from now on, and no other.
    pub(crate) fn begin(&self, packet: Vec<u8>, answers: impl IntoIterator<Item = Bursts>) {
        let (answers, mut scene) = (Answers::to(packet, answers), self.scene());
        let coming = scene.coming;
        let greetings = mem::take(&mut scene.greetings);
        *scene = Scene { answers, greetings, coming, ..Scene::default() };
    }

    /// Answers these packets too, unless one of them is the script's.
    pub(super) fn greet(&self, greeted: Vec<Greeted>) {
        self.scene().greetings = Greetings::to(greeted);
    }

    /// Whether the packet was heard, and is recorded.
    pub(crate) fn is_heard(&self) -> bool {
        self.scene().is_heard
    }

    /// What was heard is recorded.
    pub(crate) fn recorded(&self) {
        let mut scene = self.scene();
        scene.is_heard = scene.has_come;
    }

    /// Plays these bytes as soon as the line is served.
    pub(crate) fn play(&self, bytes: &[u8]) {
        self.scene().unasked.extend(bytes);
    }

    /// Whether bytes wait to be played that nobody asks for.
    pub(crate) fn is_waiting(&self) -> bool {
        !self.scene().unasked.is_empty()
    }

    /// So many bytes that were played are there.
    pub(crate) fn arrived(&self, count: usize) {
        let mut scene = self.scene();
        scene.coming = scene.coming.saturating_sub(count);
    }

    /// Whether nothing is on its way.
    pub(crate) fn is_over(&self) -> bool {
        let scene = self.scene();
        scene.coming == 0 && scene.unasked.is_empty()
    }

    fn scene(&self) -> MutexGuard<'_, Scene> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// A packet, and the packets that answer it.
pub(super) type Greeted = (Vec<u8>, Vec<Vec<u8>>);

/// Packets that are answered at once, each time that they are heard.
#[derive(Debug, Default)]
struct Greetings {
    greeted: Vec<Greeted>,
    /// The last bytes that were heard, as many as the longest packet has.
    heard: Vec<u8>,
}

impl Greetings {
    /// What answers these packets.
    fn to(greeted: Vec<Greeted>) -> Self {
        Self { greeted, heard: Vec::new() }
    }

    /// Takes a byte. Returns what answers the packet that ends with it, if it is one of them.
    fn hear(&mut self, byte: u8) -> Option<Bursts> {
        let longest = self.greeted.iter().map(|(packet, _)| packet.len()).max()?;
        self.heard.push(byte);
        let surplus = self.heard.len().saturating_sub(longest);
        self.heard.drain(..surplus);
        let (_, answers) = self.greeted.iter().find(|(packet, _)| self.heard.ends_with(packet))?;
        Some(answers.iter().map(|answer| (Duration::ZERO, answer.clone())).collect())
    }
}

impl Devices for Script {
    fn hear(&mut self, bytes: &[u8], now: Duration, send: &mut dyn FnMut(Chunk)) -> Duration {
        let mut scene = self.scene();
        let mut play = mem::take(&mut scene.unasked);
        let mut bursts: Bursts = Vec::new();
        if !play.is_empty() {
            bursts.push((Duration::ZERO, mem::take(&mut play)));
        }
        for byte in bytes {
            let greeted = scene.greetings.hear(*byte);
            if let Some(answer) = scene.answers.hear(*byte) {
                scene.has_come = true;
                bursts.extend(answer);
            } else {
                bursts.extend(greeted.unwrap_or_default());
            }
        }
        for (after, bytes) in bursts {
            scene.coming += bytes.len();
            send(Chunk { at: now + after, bytes });
        }
        now
    }

    fn restart(&mut self, _: Duration) {}

    fn alarm(&mut self, _: Alarm) {}

    fn rename(&self, _: &mut [u8]) {}

    fn free(&self) -> Duration {
        Duration::ZERO
    }

    fn is_within_packet(&self) -> bool {
        false
    }

    fn quiet(&mut self) {
        self.scene().answers.quiet();
    }

    fn first(&self, bytes: &[u8]) -> usize {
        bytes.len()
    }

    fn states(&mut self, _: Duration) -> Vec<DeviceState> {
        Vec::new()
    }
}
