//! Cancels requests when newer requests of the same kind arrive.

use std::collections::VecDeque;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Largest number of stored requests: one request per page and kind of request. Closed pages send no message, so the
/// oldest stored requests are dropped.
const MOST: usize = 256;

/// The newest request of each kind of each page.
#[derive(Default)]
pub(crate) struct Latest {
    newest: Mutex<VecDeque<Newest>>,
}

struct Newest {
    page: String,
    kind: &'static str,
    number: u64,
    stop: Arc<AtomicBool>,
}

impl Latest {
    /// Starts request `number`: cancels the older request, and returns the flag that a newer request sets to cancel
    /// this request.
    ///
    /// `None` if a newer request has already arrived.
    pub(crate) fn begin(&self, page: &str, kind: &'static str, number: u64) -> Option<Arc<AtomicBool>> {
        let mut newest = self.lock();
        if let Some(place) = newest.iter().position(|known| known.page == page && known.kind == kind) {
            if newest[place].number >= number {
                return None;
            }
            if let Some(older) = newest.remove(place) {
                older.stop.store(true, Ordering::Relaxed);
            }
        }
        if newest.len() == MOST
            && let Some(oldest) = newest.pop_front()
        {
            oldest.stop.store(true, Ordering::Relaxed);
        }
        let stop = Arc::new(AtomicBool::new(false));
        newest.push_back(Newest { page: page.to_owned(), kind, number, stop: Arc::clone(&stop) });
        Some(stop)
    }

    /// Cancels all requests.
    pub(crate) fn stop(&self) {
        for known in self.lock().iter() {
            known.stop.store(true, Ordering::Relaxed);
        }
    }

    /// Locks the list of requests. No code panics while holding the lock, so a poisoned lock is still usable.
    fn lock(&self) -> MutexGuard<'_, VecDeque<Newest>> {
        self.newest.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_newer_request_cancels_the_older_one_of_its_kind_and_page() {
        let latest = Latest::default();
        let first = latest.begin("a", "family", 1).unwrap();
        let other_kind = latest.begin("a", "point", 1).unwrap();
        let other_page = latest.begin("b", "family", 1).unwrap();
        let second = latest.begin("a", "family", 2).unwrap();
        assert!(first.load(Ordering::Relaxed));
        for going_on in [other_kind, other_page, second] {
            assert!(!going_on.load(Ordering::Relaxed));
        }
        assert!(latest.begin("a", "family", 2).is_none(), "the same number again");
        assert!(latest.begin("a", "family", 1).is_none(), "an older one that comes late");
    }

    #[test]
    fn memory_is_bounded() {
        let latest = Latest::default();
        let first = latest.begin("0", "family", 1).unwrap();
        for page in 1..=MOST {
            latest.begin(&page.to_string(), "family", 1).unwrap();
        }
        assert!(first.load(Ordering::Relaxed));
        assert_eq!(latest.lock().len(), MOST);
    }
}
