/// What the law remembers from tick to tick.
///
/// RESET
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State {
    /// Numbers of the last tick.
    pub MEMORY: [Real; 4],
}

impl State {
    /// Return the first state.
    pub const fn new() -> Self {
        Self { MEMORY: FIRST }
    }

    /// Return to the first state.
    pub fn reset(&mut self) {
        *self = Self::new();
    }
}

impl Default for State {
    fn default() -> Self {
        Self::new()
    }
}

fn keep<Answer>(answer: (Answer, [Real; 4]), memory: &mut [Real; 4]) -> Answer {
    *memory = answer.1;
    answer.0
}
