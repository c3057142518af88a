use actucheck_spec::Spec;

use super::Tokens;

/// Header and end, codes, commands with the length of their data, and the beginning of a frame of
/// each.
pub(super) fn frames(spec: &Spec) -> Tokens {
    let innfos = &spec.wires.innfos.content;
    let (header, tail) = (innfos.framing.header, innfos.framing.tail);
    let mut tokens = Tokens::from([vec![header], vec![tail], vec![tail, header]]);
    for command in &innfos.commands {
        for length in command.reply.iter().chain([&command.request]) {
            let [high, low] = length.to_be_bytes();
            tokens.insert(vec![command.code, high, low]);
            tokens.insert(vec![header, 1, command.code, high, low]);
        }
    }
    tokens
}
