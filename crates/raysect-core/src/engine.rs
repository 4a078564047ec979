//! Who does the work: numbered items in, blocks of plain numbers out, in order.

use std::any::Any;
use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc;

use crate::EngineError;

/// Computes the block of one item. It is called from several threads at once.
pub type Work<'a> = dyn Fn(usize) -> Vec<f64> + Sync + 'a;

/// Takes the blocks in the order of their items; `Break` cancels the rest of the run.
pub type Sink<'a> = dyn FnMut(usize, Vec<f64>) -> ControlFlow<()> + 'a;

/// Distributes numbered work items.
///
/// An implementation calls `work` once for each item below `items`, on any thread or machine, and hands the blocks
/// to `sink` in ascending order of items on the calling thread. After `Break` it starts no further items and
/// returns `Ok`. A panic in `work` becomes an error; blocks of the items before it are delivered.
pub trait Engine: Send + Sync {
    /// Runs the items.
    ///
    /// # Errors
    /// [`EngineError::Panicked`], [`EngineError::Threads`].
    fn run(&self, items: usize, work: &Work<'_>, sink: &mut Sink<'_>) -> Result<(), EngineError>;

    /// How many items are worked on at once.
    #[doc(alias = "worker_count")]
    fn workers(&self) -> usize;
}

fn guarded(item: usize, work: &Work<'_>) -> Result<Vec<f64>, EngineError> {
    catch_unwind(AssertUnwindSafe(|| work(item)))
        .map_err(|panic| EngineError::Panicked { item, message: text(&*panic) })
}

fn text(panic: &(dyn Any + Send)) -> String {
    let known = panic.downcast_ref::<&str>().map(|s| (*s).to_owned());
    known.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_else(|| "(no message)".to_owned())
}

/// Works on the calling thread, one item after the other.
#[derive(Debug, Clone, Copy, Default)]
#[doc(alias = "SerialEngine")]
pub struct Serial;

impl Engine for Serial {
    fn run(&self, items: usize, work: &Work<'_>, sink: &mut Sink<'_>) -> Result<(), EngineError> {
        for item in 0..items {
            if sink(item, guarded(item, work)?).is_break() {
                break;
            }
        }
        Ok(())
    }

    fn workers(&self) -> usize {
        1
    }
}

/// Works on several threads of this machine.
#[derive(Debug)]
#[doc(alias = "MulticoreEngine")]
pub struct Multicore {
    pool: rayon::ThreadPool,
}

impl Multicore {
    /// On all processors that this process may use.
    ///
    /// # Errors
    /// [`EngineError::Threads`] if the threads cannot be started.
    pub fn new() -> Result<Self, EngineError> {
        Self::with_threads(std::thread::available_parallelism().map_or(1, usize::from))
    }

    /// On a number of threads.
    ///
    /// # Errors
    /// [`EngineError::NoThreads`] for none, [`EngineError::Threads`] if they cannot be started.
    pub fn with_threads(threads: usize) -> Result<Self, EngineError> {
        if threads == 0 {
            return Err(EngineError::NoThreads(threads));
        }
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        Ok(Self { pool: pool.map_err(|e| EngineError::Threads(e.to_string()))? })
    }
}

impl Engine for Multicore {
    fn run(&self, items: usize, work: &Work<'_>, sink: &mut Sink<'_>) -> Result<(), EngineError> {
        let (next, cancelled) = (AtomicUsize::new(0), AtomicBool::new(false));
        let (sender, results) = mpsc::channel();
        let mut outcome = Ok(());
        self.pool.in_place_scope(|scope| {
            for _ in 0..self.workers() {
                let (sender, next, cancelled) = (sender.clone(), &next, &cancelled);
                scope.spawn(move |_| {
                    while !cancelled.load(Ordering::Relaxed) {
                        let item = next.fetch_add(1, Ordering::Relaxed);
                        if item >= items || sender.send((item, guarded(item, work))).is_err() {
                            break;
                        }
                    }
                });
            }
            drop(sender);
            outcome = in_order(&results, sink);
            cancelled.store(true, Ordering::Relaxed);
        });
        outcome
    }

    fn workers(&self) -> usize {
        self.pool.current_num_threads()
    }
}

/// Hands blocks on in the order of their items, whatever the order of their arrival.
fn in_order(
    results: &mpsc::Receiver<(usize, Result<Vec<f64>, EngineError>)>,
    sink: &mut Sink<'_>,
) -> Result<(), EngineError> {
    let (mut waiting, mut next) = (BTreeMap::new(), 0);
    for (item, block) in results {
        waiting.insert(item, block);
        while let Some(block) = waiting.remove(&next) {
            if sink(next, block?).is_break() {
                return Ok(());
            }
            next += 1;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn engines() -> Vec<Box<dyn Engine>> {
        let multicore = |n| Box::new(Multicore::with_threads(n).unwrap()) as Box<dyn Engine>;
        vec![Box::new(Serial), multicore(1), multicore(2), multicore(7)]
    }

    #[test]
    fn blocks_come_in_order() {
        for engine in engines() {
            let mut seen = Vec::new();
            let run = engine.run(100, &|i| vec![i as f64], &mut |i, block| {
                seen.push((i, block[0]));
                ControlFlow::Continue(())
            });
            assert!(run.is_ok());
            assert_eq!(seen, (0..100).map(|i| (i, i as f64)).collect::<Vec<_>>());
        }
    }

    #[test]
    fn a_panic_is_an_error_and_loses_no_finished_work() {
        for engine in engines() {
            let mut delivered = 0;
            let work = |i: usize| {
                assert!(i != 40, "material of item {i}");
                vec![1.0]
            };
            let run = engine.run(100, &work, &mut |_, _| {
                delivered += 1;
                ControlFlow::Continue(())
            });
            let Err(EngineError::Panicked { item: 40, message }) = run else { panic!("{run:?}") };
            assert!(message.contains("material of item 40"));
            assert_eq!(delivered, 40);
        }
    }

    #[test]
    fn breaking_ends_the_run() {
        for engine in engines() {
            let mut delivered = 0;
            let run = engine.run(1000, &|_| vec![], &mut |_, _| {
                delivered += 1;
                if delivered == 10 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            });
            assert!(run.is_ok());
            assert_eq!(delivered, 10);
        }
        assert!(Multicore::with_threads(0).is_err());
    }
}
