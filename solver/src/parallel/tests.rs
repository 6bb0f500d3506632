//! Every item is worked on once, with its own number, whatever the number of threads.

use super::prelude::*;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Calls `check` in pools of several sizes, one thread among them.
fn in_pools(check: impl Fn() + Sync) {
    for threads in [1, 2, 3, 8] {
        rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a thread pool").install(&check);
    }
}

#[test]
fn chunks_have_their_numbers_and_the_last_may_be_short() {
    in_pools(|| {
        for length in [0, 1, 7, 64, 65, 1000] {
            let mut values = vec![0; length];
            values.par_chunks_mut(7).enumerate().for_each(|(chunk, values)| {
                for (offset, value) in values.iter_mut().enumerate() {
                    *value += 7 * chunk + offset + 1;
                }
            });
            assert!(values.iter().enumerate().all(|(index, value)| *value == index + 1), "{length}");
        }
    });
}

#[test]
fn items_side_by_side_belong_together_up_to_the_shortest() {
    in_pools(|| {
        let source: Vec<usize> = (0..300).collect();
        let (mut one, mut other, mut last) = (vec![0; 301], vec![0; 400], vec![0; 300]);
        (&mut one, (&source, &mut other), &mut last).enumerate().with_min_len(16).for_each(
            |(index, (one, (source, other), last))| {
                *one += source + 1;
                *other += index + 2;
                *last += source + 3;
            },
        );
        for index in 0..300 {
            assert_eq!((one[index], other[index], last[index]), (index + 1, index + 2, index + 3));
        }
        assert_eq!((one[300], other[300]), (0, 0));
    });
}

#[test]
fn a_reduction_is_that_of_a_plain_loop() {
    in_pools(|| {
        let values: Vec<f64> = (0..1000).map(|k| f64::from(k * 7919 % 1009)).collect();
        let largest = values.par_chunks(16).map(|values| values.iter().copied().fold(0.0, f64::max));
        assert_eq!(largest.reduce(|| 0.0, f64::max), values.iter().copied().fold(0.0, f64::max));
        let none: &[f64] = &[];
        assert_eq!(none.map(|value| *value).reduce(|| -1.0, f64::max), -1.0);
    });
}

#[test]
fn parts_have_the_least_length_that_is_asked_for() {
    in_pools(|| {
        let values = vec![1; 1000];
        let parts = AtomicUsize::new(0);
        let queue = super::Queue::new(values[..].with_min_len(300));
        while let Some(part) = queue.next() {
            parts.fetch_add(1, Ordering::Relaxed);
            assert!(part.length() >= 100, "{}", part.length());
        }
        assert!(parts.into_inner() <= 4);
    });
}

#[test]
fn a_panic_comes_back_and_leaves_the_pool_usable() {
    in_pools(|| {
        let mut values = vec![0; 100];
        let panicked = catch_unwind(AssertUnwindSafe(|| {
            values.par_iter_mut().enumerate().for_each(|(index, _)| assert!(index != 57, "this one"));
        }));
        assert!(panicked.is_err());
        values.par_iter_mut().for_each(|value| *value = 1);
        assert_eq!(values.iter().sum::<i32>(), 100);
    });
}

#[test]
fn a_loop_within_a_loop_ends() {
    in_pools(|| {
        let mut rows = vec![vec![0_u64; 50]; 40];
        rows.par_iter_mut().enumerate().for_each(|(row, values)| {
            values.par_iter_mut().enumerate().for_each(|(column, value)| *value = (row * column) as u64);
        });
        assert_eq!(rows.iter().flatten().sum::<u64>(), (39 * 40 / 2) * (49 * 50 / 2));
    });
}
