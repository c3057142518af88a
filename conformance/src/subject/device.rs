//! A device on its port.

mod counts;
mod decided;
mod keeper;
mod line;
mod other_host;
mod record;
mod slave;

use std::io::{Error, ErrorKind};
use std::sync::{Arc, Mutex, PoisonError};

use actucheck_spec::model::Role;

use super::{Answer, Subject};
use crate::adapter::{Hello, Implementation, Limits, Output, Permissions, Question, VERSION};
use crate::port::PortError;
use crate::traffic::Traffic;

pub use self::keeper::{Keeper, Kept};
pub use self::line::{Line, SHORTEST_PAUSE};
pub(crate) use self::slave::plays;
pub use self::slave::{Slave, SlaveError};

/// A device on its port. Copies share the port.
#[derive(Clone, Debug)]
pub struct Device {
    hello: Hello,
    line: Arc<Mutex<Line>>,
    allowed: Permissions,
    /// Keeps what it holds, if it may be written to.
    keeper: Arc<Mutex<Option<Keeper>>>,
}

impl Device {
    /// A device of this name and firmware on a line.
    #[must_use]
    pub fn new(name: String, firmware: String, line: Line, allowed: Permissions) -> Self {
        let language = "a device".to_owned();
        let implementation = Implementation { name, version: firmware, language, url: None };
        let hello = Hello {
            protocol: VERSION,
            implementation: implementation.legible(),
            wires: vec![line.wire.id().to_owned()],
            ops: vec!["device".to_owned()],
            roles: vec![Role::Device],
            calls: None,
            max_in_flight: 1,
            limits: Limits::default(),
        };
        let (line, keeper) = (Arc::new(Mutex::new(line)), Arc::default());
        Self { hello, line, allowed, keeper }
    }

    /// The same device, which is a library's.
    #[must_use]
    pub fn of_library(mut self, library: Implementation) -> Self {
        self.hello.implementation = library.legible();
        self
    }

    /// The same device, of which this keeper keeps what it holds. Without one nothing is written to it.
    #[must_use]
    pub fn kept_by(mut self, keeper: Keeper) -> Self {
        self.keeper = Arc::new(Mutex::new(Some(keeper)));
        self
    }

    /// Sets the device back to what it held before, and says what came of it; `None` if nothing was written.
    #[must_use]
    pub fn end(&self) -> Option<Kept> {
        let mut keeper = self.keeper.lock().unwrap_or_else(PoisonError::into_inner);
        let mut line = self.line.lock().unwrap_or_else(PoisonError::into_inner);
        keeper.as_mut()?.end(&mut *line)
    }

    /// Looks at the line.
    pub fn look<T>(&self, look: impl FnOnce(&Line) -> T) -> T {
        look(&self.line.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

impl Subject for Device {
    fn hello(&self) -> &Hello {
        &self.hello
    }

    fn ask(&mut self, question: &Question) -> Answer {
        let Question::Device { needs, neighbour, steps, .. } = question else {
            return Answer::Skipped("a device has only its port".to_owned());
        };
        let missing = needs.without(&self.allowed);
        if !missing.only_read() {
            return Answer::Skipped(format!("it needs --allow {missing}"));
        }
        let mut keeper = self.keeper.lock().unwrap_or_else(PoisonError::into_inner);
        let mut line = self.line.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(gone) = &line.gone {
            return Answer::NotAsked(gone.clone());
        }
        let heard = if needs.only_read() {
            line.converse(steps)
        } else {
            let Some(keeper) = keeper.as_mut() else {
                return Answer::Skipped("nothing keeps what its registers hold".to_owned());
            };
            if let Err(reason) = keeper.before(needs, *neighbour, &mut *line) {
                return Answer::Skipped(reason);
            }
            let heard = line.converse(steps);
            // A library that failed has its device still.
            if heard.as_ref().err().is_none_or(is_library) {
                keeper.after(*neighbour, &mut *line);
            }
            heard
        };
        match heard {
            _ if line.is_interrupted() => Answer::NotAsked("interrupted".to_owned()),
            Ok(heard) => Answer::Ok(Output::Line(heard)),
            Err(error) if is_library(&error) => Answer::Crashed(error.to_string()),
            Err(error) => {
                let gone = PortError::new(&line.place, error).to_string();
                line.gone = Some(gone.clone());
                Answer::NotAsked(gone)
            }
        }
    }

    fn traffic(&self) -> Option<Traffic> {
        Some(self.look(Line::traffic))
    }

    /// The same device is asked again what failed.
    fn another(&self) -> Option<Box<dyn Subject + Send>> {
        Some(Box::new(self.clone()))
    }
}

/// Whether the library of a device that is behind an adapter has failed.
fn is_library(error: &Error) -> bool {
    error.kind() == ErrorKind::InvalidData
}
