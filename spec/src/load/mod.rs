//! Reads the YAML into the model. Errors carry file, line and column.

mod bounds;
mod position;

#[cfg(feature = "exports")]
use std::borrow::Cow;
use std::sync::{Arc, OnceLock};

use position::Places;
#[cfg(feature = "exports")]
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::de::DeserializeOwned;
use serde::{Serialize, Serializer};

use crate::Diagnostic;
use crate::model::{
    Citation, Device, Document, DocumentsFile, ErrataFile, Erratum, Range, Requirement,
    RequirementsFile, SentencesFile, Status, Vector, VectorsFile,
};
use crate::validate;
use crate::wire::{Wire, Wires};

/// The text of one YAML file.
#[derive(Clone, Debug)]
pub struct Source {
    /// Path relative to the workspace, with forward slashes: `spec/errata.yaml`.
    pub path: String,
    /// The whole file.
    pub text: String,
    /// The same as JSON, if this crate was built with it and so needs no check of its YAML.
    json: Option<&'static str>,
}

impl Source {
    /// A source from its parts. `path` is relative to the spec folder and determines the kind of
    /// the file: `documents.yaml`, `errata.yaml`, or a file in `wires`, `devices`, `vectors`,
    /// `requirements` or `sentences`.
    #[must_use]
    pub fn new(path: &str, text: &str) -> Self {
        Self { path: format!("spec/{path}"), text: text.to_owned(), json: None }
    }
}

/// Path below the spec folder of each file, its text and the same as JSON, as `build.rs` lists them.
static EMBEDDED: &[(&str, &str, &str)] = include!(concat!(env!("OUT_DIR"), "/sources.rs"));

/// The files that this crate was built with.
#[must_use]
pub fn embedded() -> Vec<Source> {
    EMBEDDED.iter().map(|(path, text, _)| Source::new(path, text)).collect()
}

/// The same, to be read as JSON.
fn as_json() -> Vec<Source> {
    let sources = EMBEDDED.iter();
    sources
        .map(|(path, text, json)| Source { json: Some(json), ..Source::new(path, text) })
        .collect()
}

/// The content of one YAML file, with its text.
#[derive(Clone, Debug)]
pub struct File<T> {
    path: String,
    text: Arc<str>,
    /// Computed for the first defect.
    places: OnceLock<Places>,
    /// The file's content.
    pub content: T,
}

impl<T: DeserializeOwned> File<T> {
    fn read(source: &Source) -> Result<Self, Diagnostic> {
        let (path, text) = (source.path.clone(), Arc::from(&source.text[..]));
        let content = match source.json {
            // Another reader is as much to compile again, and a build script reads once.
            #[cfg(feature = "exports")]
            Some(json) => serde_json::from_str(json).map_err(|error| ((1, 1), error.to_string())),
            _ => bounds::check(&text)
                .and_then(|()| serde_yaml::from_str(&text).map_err(|error| defect(&error))),
        };
        let content =
            content.map_err(|(place, message)| Diagnostic::new(&path, &text, place, message))?;
        Ok(Self { path, text, places: OnceLock::new(), content })
    }
}

impl<T> File<T> {
    /// Path relative to the workspace.
    #[must_use]
    pub fn path(&self) -> &str {
        &self.path
    }

    /// A defect at the node with the path `node`, such as `registers[3].range.min`, or at the
    /// nearest existing node around it.
    #[must_use]
    pub fn diagnostic(&self, node: &str, message: String) -> Diagnostic {
        let places = self.places.get_or_init(|| Places::of(&self.text));
        Diagnostic::new(&self.path, &self.text, places.find(node), message)
    }
}

/// The file's content.
impl<T: Serialize> Serialize for File<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.content.serialize(serializer)
    }
}

#[cfg(feature = "exports")]
impl<T: JsonSchema> JsonSchema for File<T> {
    fn schema_name() -> Cow<'static, str> {
        T::schema_name()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        T::json_schema(generator)
    }
}

/// The content of a YAML text that may be made to exhaust its reader. Its size is the caller's to
/// limit.
///
/// # Errors
/// What is wrong, with line and column.
pub fn yaml<T: DeserializeOwned>(text: &str) -> Result<T, String> {
    let told =
        |((line, column), message): Defect| format!("{message} at line {line} column {column}");
    bounds::depth(text).map_err(told)?;
    serde_yaml::from_str(text).map_err(|error| error.to_string())
}

/// Line and column, both from 1, and the reader's message.
type Defect = ((usize, usize), String);

/// The reader's message, which ends with the place.
fn defect(error: &serde_yaml::Error) -> Defect {
    let place = error.location().map_or((1, 1), |at| (at.line(), at.column()));
    let mut message = error.to_string();
    message.truncate(message.rfind(" at line ").unwrap_or(message.len()));
    (place, message)
}

/// The content of the spec folder, read and validated.
#[derive(Clone, Debug)]
pub struct Spec {
    /// The documents that citations point to.
    pub documents: File<DocumentsFile>,
    /// The wires, a file each.
    pub wires: Wires,
    /// The control tables, one file per device.
    pub devices: Vec<File<Device>>,
    /// The test vectors, one file per section of a document.
    pub vectors: Vec<File<VectorsFile>>,
    /// The requirements, one file per document.
    pub requirements: Vec<File<RequirementsFile>>,
    /// The documents' defects.
    pub errata: File<ErrataFile>,
    /// The use of each sentence, one file per document.
    pub sentences: Vec<File<SentencesFile>>,
}

impl Spec {
    /// The spec that this crate was built with, which is not validated again: the codec's build and the
    /// tests do, by [`Spec::read`] of [`embedded()`].
    ///
    /// # Errors
    /// The files that the model does not fit. There are none if the tests pass.
    pub fn embedded() -> Result<Self, Vec<Diagnostic>> {
        Self::parse(&as_json())
    }

    /// Reads and validates `sources`.
    ///
    /// # Errors
    /// All defects found: those of the YAML first, then those of its content.
    pub fn read(sources: &[Source]) -> Result<Self, Vec<Diagnostic>> {
        let spec = Self::parse(sources)?;
        let defects = validate::all(&spec);
        if defects.is_empty() { Ok(spec) } else { Err(defects) }
    }

    /// The embedded spec's wires with a device that is not part of it, read and validated. `path`
    /// is the file's name in defects. The device cites documents of its own.
    ///
    /// # Errors
    /// Every defect found in `text`.
    pub fn with_own_device(path: &str, text: &str) -> Result<Self, Vec<Diagnostic>> {
        let own = |source: &Source| {
            ["documents.yaml", "errata.yaml", "wires/"]
                .iter()
                .any(|name| source.path.starts_with(&format!("spec/{name}")))
        };
        let wires: Vec<_> = as_json().into_iter().filter(own).collect();
        let mut spec = Self::parse(&wires)?;
        let source = Source { path: path.to_owned(), text: text.to_owned(), json: None };
        let device: File<Device> = File::read(&source).map_err(|defect| vec![defect])?;
        let rows = device.content.registers.iter().flat_map(|row| &row.source);
        for citation in device.content.source.iter().chain(rows) {
            if spec.document(&citation.document).is_none() {
                spec.documents.content.documents.push(Document::own(&citation.document));
            }
        }
        spec.devices = vec![device];
        let mut defects = validate::all(&spec);
        defects.retain(|defect| defect.path == path);
        if defects.is_empty() { Ok(spec) } else { Err(defects) }
    }

    fn parse(sources: &[Source]) -> Result<Self, Vec<Diagnostic>> {
        let mut reader = Reader { sources, defects: Vec::new() };
        let documents = reader.one("documents.yaml");
        let wires = Wires::read(&mut reader);
        reader.other_wires();
        let devices = reader.folder("devices/");
        let vectors = reader.folder("vectors/");
        let requirements = reader.folder("requirements/");
        let errata = reader.one("errata.yaml");
        let sentences = reader.folder("sentences/");
        match (documents, wires, errata) {
            (Some(documents), Some(wires), Some(errata)) if reader.defects.is_empty() => {
                Ok(Self { documents, wires, devices, vectors, requirements, errata, sentences })
            }
            _ => Err(reader.defects),
        }
    }

    /// The document with this id.
    #[must_use]
    pub fn document(&self, id: &str) -> Option<&Document> {
        self.documents.content.documents.iter().find(|document| document.id == id)
    }

    /// The device with this id.
    #[must_use]
    pub fn device(&self, id: &str) -> Option<&Device> {
        self.devices.iter().map(|file| &file.content).find(|device| device.device == id)
    }

    /// The requirement with this id.
    #[must_use]
    pub fn requirement(&self, id: &str) -> Option<&Requirement> {
        self.requirements
            .iter()
            .flat_map(|file| &file.content.requirements)
            .find(|requirement| requirement.id == id)
    }

    /// The erratum with this id.
    #[must_use]
    pub fn erratum(&self, id: &str) -> Option<&Erratum> {
        self.errata.content.errata.iter().find(|erratum| erratum.id == id)
    }

    /// Whether one of these errata is open.
    #[must_use]
    pub fn depends_on_open(&self, errata: &[String]) -> bool {
        let open = |id: &String| self.erratum(id).is_some_and(|row| row.status == Status::Open);
        errata.iter().any(open)
    }

    /// Whether the documents agree on a range: it depends on no open erratum.
    #[must_use]
    pub fn settles(&self, range: &Range) -> bool {
        !self.depends_on_open(&range.errata)
    }

    /// The use of each sentence of a document, if the file exists.
    #[must_use]
    pub fn sentences_of(&self, document: &str) -> Option<&SentencesFile> {
        self.sentences.iter().map(|file| &file.content).find(|file| file.document == document)
    }

    /// Every vector with its file, in the order of files and of rows.
    pub fn vectors(&self) -> impl Iterator<Item = (&VectorsFile, &Vector)> {
        self.vectors
            .iter()
            .flat_map(|file| file.content.vectors.iter().map(move |vector| (&file.content, vector)))
    }

    /// A citation in words: the document's title and the section.
    #[must_use]
    pub fn place(&self, citation: &Citation) -> String {
        let title = self
            .document(&citation.document)
            .map_or(citation.document.as_str(), |document| document.title.as_str());
        format!("{title}, {}", citation.section)
    }
}

/// Reads files one after the other and collects their defects.
pub(crate) struct Reader<'a> {
    sources: &'a [Source],
    defects: Vec<Diagnostic>,
}

impl Reader<'_> {
    fn one<T: DeserializeOwned>(&mut self, name: &str) -> Option<File<T>> {
        let files = self.folder(name);
        if files.is_empty() && self.defects.is_empty() {
            let message = format!("the file {name} is missing from the spec folder");
            self.defects.push(Diagnostic::new(
                &format!("spec/{name}"),
                &"".into(),
                (1, 1),
                message,
            ));
        }
        files.into_iter().next()
    }

    /// A file of an unknown wire.
    fn other_wires(&mut self) {
        for source in self.sources {
            let name = source.path.strip_prefix("spec/wires/");
            let name = name.and_then(|name| name.strip_suffix(".yaml"));
            if let Some(Err(message)) = name.map(str::parse::<Wire>) {
                let text = Arc::from(&source.text[..]);
                self.defects.push(Diagnostic::new(&source.path, &text, (1, 1), message));
            }
        }
    }

    /// The file of a wire.
    pub(crate) fn wire<T: DeserializeOwned>(&mut self, wire: Wire) -> Option<File<T>> {
        self.one(&format!("wires/{wire}.yaml"))
    }

    fn folder<T: DeserializeOwned>(&mut self, prefix: &str) -> Vec<File<T>> {
        let mut files = Vec::new();
        let wanted =
            |path: &str| path.strip_prefix("spec/").is_some_and(|name| name.starts_with(prefix));
        for source in self.sources.iter().filter(|source| wanted(&source.path)) {
            match File::read(source) {
                Ok(file) => files.push(file),
                Err(defect) => self.defects.push(defect),
            }
        }
        files
    }
}
