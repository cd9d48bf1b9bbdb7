//! Independent work on all cores.
//!
//! A parallel iterator is compiled anew for every kind of work and of result, and is long; so there is one.

use std::sync::{Mutex, PoisonError};

use rayon::iter::{IntoParallelIterator, ParallelIterator};

/// What is made of every item, on all cores, in the order of the items.
pub(crate) fn in_parallel<T: Send, U: Send>(
    items: impl IntoIterator<Item = T>,
    make: impl Fn(T) -> U + Sync,
) -> Vec<U> {
    let places: Vec<Mutex<(Option<T>, Option<U>)>> =
        items.into_iter().map(|item| Mutex::new((Some(item), None))).collect();
    on_all_cores(places.len(), &|index| {
        // Held while it is made: nobody else comes to this place.
        let mut place = places[index].lock().unwrap_or_else(PoisonError::into_inner);
        place.1 = place.0.take().map(&make);
    });
    let places = places.into_iter().map(Mutex::into_inner);
    places.filter_map(|place| place.unwrap_or_else(PoisonError::into_inner).1).collect()
}

fn on_all_cores(count: usize, work: &(dyn Fn(usize) + Sync)) {
    (0..count).into_par_iter().for_each(work);
}

#[cfg(test)]
mod tests {
    use super::in_parallel;

    #[test]
    fn results_stand_in_the_order_of_the_items() {
        let words = || (0..1000).map(|number: u32| number.to_string());
        assert_eq!(
            in_parallel(words(), |word| word.len()),
            words().map(|word| word.len()).collect::<Vec<_>>()
        );
        assert!(in_parallel(Vec::<u8>::new(), u32::from).is_empty());
    }

    #[test]
    fn work_within_work_ends() {
        let sums =
            in_parallel(0..50_u32, |many| in_parallel(0..many, |one| one).iter().sum::<u32>());
        assert_eq!(sums[49], 49 * 48 / 2);
    }
}
