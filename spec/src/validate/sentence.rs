//! Rule: the files of sentences and the spec agree. Every name in them exists, every cited section
//! is in the document, and every requirement follows from a sentence of its cited section.

use crate::load::File;
use crate::model::{Citation, SentencesFile};
use crate::wire::Wire;
use crate::{Diagnostic, Spec};

pub(super) fn check(spec: &Spec) -> Vec<Diagnostic> {
    let mut defects = Vec::new();
    for file in &spec.sentences {
        accounts(spec, file, &mut defects);
    }
    for file in &spec.requirements {
        for (index, row) in file.content.requirements.iter().enumerate() {
            let Some(sentences) = spec.sentences_of(&row.source.document) else { continue };
            let mut own = sentences.under(&row.source.section).flat_map(|part| &part.sentences);
            if is_section(spec, &row.source) && !own.any(|sentence| sentence.of.contains(&row.id)) {
                let node = format!("requirements[{index}].source");
                let message = format!(
                    "no sentence of {} is said to be of {}; look for it in spec/sentences",
                    row.source, row.id
                );
                defects.push(file.diagnostic(&node, message));
            }
        }
    }
    defects
}

/// Whether a citation's section is in its document, if the sections of the document are known.
pub(super) fn is_section(spec: &Spec, source: &Citation) -> bool {
    spec.sentences_of(&source.document)
        .is_none_or(|file| file.sections.iter().any(|row| row.section == source.section))
}

fn accounts(spec: &Spec, file: &File<SentencesFile>, defects: &mut Vec<Diagnostic>) {
    let content = &file.content;
    if spec.document(&content.document).is_none() {
        defects
            .push(file.diagnostic("document", format!("unknown document `{}`", content.document)));
    }
    let mut last = 0;
    for (index, section) in content.sections.iter().enumerate() {
        for (place, sentence) in section.sentences.iter().enumerate() {
            let node = format!("sections[{index}].sentences[{place}]");
            if sentence.line < last || sentence.line < section.line {
                let message = format!("line {} stands after line {last}", sentence.line);
                defects.push(file.diagnostic(&format!("{node}.line"), message));
            }
            last = sentence.line;
            let message = if sentence.of.is_empty() {
                Some("say what it is of, or `no demand`".to_owned())
            } else if sentence.is_no_demand() && sentence.of.len() > 1 {
                Some("a sentence is of something, or makes no demand, not both".to_owned())
            } else {
                let unknown = sentence.of.iter().find(|of| !exists(spec, of));
                unknown.filter(|_| !sentence.is_no_demand()).map(|of| {
                    format!("`{of}` is no requirement, erratum, register, instruction or command")
                })
            };
            defects.extend(message.map(|message| file.diagnostic(&format!("{node}.of"), message)));
        }
    }
}

fn exists(spec: &Spec, of: &str) -> bool {
    let Some((whole, part)) = of.split_once('/') else {
        return spec.requirement(of).is_some() || spec.erratum(of).is_some();
    };
    let register = || spec.device(whole).is_some_and(|device| device.register(part).is_some());
    register()
        || whole.parse::<Wire>().is_ok_and(|wire| wire.asks(spec).iter().any(|row| row.id == of))
}
