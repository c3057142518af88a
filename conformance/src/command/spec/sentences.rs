//! `actucheck spec coverage --sentences`: what became of the documents' sentences.

use actucheck_spec::Spec;
use actucheck_spec::model::Sentence;

use crate::command::shared::table;

/// A line a document, and their sum. A sentence that is of several things counts for each of them.
pub(super) fn text(spec: &Spec, document: Option<&str>) -> String {
    let head = ["document", "sentences", "of requirements", "of errata", "of tables", "no demand"];
    let mut rows = vec![head.map(str::to_owned)];
    let mut sum = [0; 5];
    let files = spec.sentences.iter().map(|file| &file.content);
    for file in files.filter(|file| document.is_none_or(|id| file.document == id)) {
        let count = |counts: &dyn Fn(&Sentence) -> bool| {
            file.sentences().filter(|(_, row)| counts(row)).count()
        };
        let of = |counts: &dyn Fn(&str) -> bool| count(&|row| row.of.iter().any(|id| counts(id)));
        let counts = [
            count(&|_| true),
            of(&|id| spec.requirement(id).is_some()),
            of(&|id| spec.erratum(id).is_some()),
            of(&|id| id.contains('/')),
            count(&Sentence::is_no_demand),
        ];
        rows.push(row(&file.document, counts));
        for (sum, count) in sum.iter_mut().zip(counts) {
            *sum += count;
        }
    }
    if rows.len() > 2 {
        rows.push(row("all", sum));
    }
    table::lines("", &rows).join("\n") + "\n"
}

fn row(name: &str, counts: [usize; 5]) -> [String; 6] {
    let [all, rows, errata, data, nothing] = counts.map(|count| count.to_string());
    [name.to_owned(), all, rows, errata, data, nothing]
}
