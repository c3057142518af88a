//! The fenced blocks of a Markdown file.

/// A fenced block.
pub(crate) struct Block<'a> {
    /// What follows the fence, such as `sh`.
    pub(crate) language: &'a str,
    /// Its lines.
    pub(crate) body: &'a str,
}

/// The fenced blocks of a page, in their order.
pub(crate) fn blocks(page: &str) -> impl Iterator<Item = Block<'_>> {
    page.split("\n```").skip(1).step_by(2).map(|block| {
        let (language, body) = block.split_once('\n').unwrap_or((block, ""));
        Block { language, body }
    })
}
