#[cfg(feature = "exports")]
use schemars::JsonSchema;
use serde::Deserialize;

/// The value of `of` for a sentence that requires nothing and names nothing.
pub const NO_DEMAND: &str = "no demand";

/// A file of `sentences/`: every sentence of a document, and its use.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct SentencesFile {
    /// Id of the document.
    pub document: String,
    /// Its sections, in their order.
    pub sections: Vec<Section>,
}

impl SentencesFile {
    /// Every sentence, with its section.
    pub fn sentences(&self) -> impl Iterator<Item = (&Section, &Sentence)> {
        self.sections
            .iter()
            .flat_map(|section| section.sentences.iter().map(move |sentence| (section, sentence)))
    }

    /// The sections with this name, each with the sections inside it.
    pub fn under<'a>(&'a self, name: &'a str) -> impl Iterator<Item = &'a Section> {
        let named = self.sections.iter().enumerate().filter(move |(_, row)| row.section == name);
        named.flat_map(|(index, outer)| {
            let within = self.sections.iter().skip(index + 1);
            [outer].into_iter().chain(within.take_while(|inner| inner.level > outer.level))
        })
    }
}

/// A section of a document.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Section {
    /// Its name in citations: its number or its heading, with the meaning after a heading that is
    /// not in English.
    pub section: String,
    /// Its heading, if citations use its number.
    pub title: Option<String>,
    /// Its depth; a section contains the following sections that are deeper.
    pub level: u8,
    /// The line that it begins with, from 1.
    pub line: usize,
    /// Its sentences, without those of sections inside it.
    #[serde(default)]
    pub sentences: Vec<Sentence>,
}

/// A sentence, a row of a table or a block of code.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Sentence {
    /// The line that it begins on, from 1.
    pub line: usize,
    /// The 32-bit FNV-1a hash of its text.
    pub hash: u32,
    /// Its first words.
    pub words: String,
    /// Its use: ids of requirements and errata, `DEVICE/REGISTER`, `WIRE/INSTRUCTION`,
    /// `WIRE/COMMAND` with the command's code, or `no demand`.
    pub of: Vec<String>,
}

impl Sentence {
    /// Whether it requires nothing and names nothing.
    #[must_use]
    pub fn is_no_demand(&self) -> bool {
        self.of.iter().any(|of| of == NO_DEMAND)
    }
}
