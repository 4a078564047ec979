//! Room for a second spectrum at a hit.

use std::cell::RefCell;

thread_local! {
    /// As many as modifiers have ever been nested on this thread.
    static BUFFERS: RefCell<Vec<Vec<f64>>> = const { RefCell::new(Vec::new()) };
}

/// Lends a spectrum of so many bins, of any content. Nothing is allocated once a thread has as many as it needs.
pub(super) fn with_buffer<T>(bins: usize, work: impl FnOnce(&mut [f64]) -> T) -> T {
    let mut buffer = BUFFERS.with(|all| all.borrow_mut().pop()).unwrap_or_default();
    buffer.resize(bins, 0.0);
    let answer = work(&mut buffer);
    BUFFERS.with(|all| all.borrow_mut().push(buffer));
    answer
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn buffers_are_lent_one_within_another_and_come_back() {
        let places = || {
            with_buffer(4, |outer| {
                let inner = with_buffer(9, |inner| {
                    inner.fill(1.0);
                    inner.as_ptr()
                });
                outer.fill(2.0);
                assert_ne!(outer.as_ptr(), inner);
                assert_eq!(outer, [2.0; 4]);
                BUFFERS.with(|all| all.borrow().len())
            })
        };
        assert_eq!((places(), places()), (1, 1));
        assert_eq!(BUFFERS.with(|all| all.borrow().len()), 2);
    }
}
