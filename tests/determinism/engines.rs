//! Engines of a user.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};

use raysect::core::{Engine, EngineError};
use raysect::prelude::*;

/// What computes an item.
type Work<'a> = dyn Fn(usize) -> Vec<f64> + Sync + 'a;
/// What takes the results.
type Sink<'a> = dyn FnMut(usize, Vec<f64>) -> ControlFlow<()> + 'a;

/// Works on the last item first, and claims a number of workers that fits nothing else.
#[derive(Debug)]
pub(crate) struct Reversed;

impl Engine for Reversed {
    fn run(&self, items: usize, work: &Work<'_>, sink: &mut Sink<'_>) -> Result<(), EngineError> {
        let mut blocks: Vec<_> = (0..items).rev().map(work).collect();
        for item in 0..items {
            if sink(item, blocks.pop().unwrap()).is_break() {
                break;
            }
        }
        Ok(())
    }

    fn workers(&self) -> usize {
        5
    }
}

/// Cancels an observation while it works on an item of a certain number, counted over all passes.
#[derive(Debug)]
pub(crate) struct Cancelling {
    token: CancelToken,
    left: AtomicUsize,
}

impl Cancelling {
    /// With the handle that it uses, after a number of items.
    pub(crate) fn after(items: usize, token: &CancelToken) -> Self {
        Self { token: token.clone(), left: AtomicUsize::new(items) }
    }
}

impl Engine for Cancelling {
    fn run(&self, items: usize, work: &Work<'_>, sink: &mut Sink<'_>) -> Result<(), EngineError> {
        let counted = |item| {
            if self.left.fetch_sub(1, Ordering::Relaxed) == 1 {
                self.token.cancel();
            }
            work(item)
        };
        Serial.run(items, &counted, sink)
    }

    fn workers(&self) -> usize {
        1
    }
}
