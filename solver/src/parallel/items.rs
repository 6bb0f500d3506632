//! Items of parallel loops: slices, chunks of slices, and several of them side by side.

/// Items of known number that can be divided.
pub(crate) trait Items: Sized + Send {
    /// An item.
    type Item;
    /// Number of items.
    fn length(&self) -> usize;
    /// The first N items, and the others.
    fn divided(self, place: usize) -> (Self, Self);
    /// The items one after the other.
    fn sequence(self) -> impl Iterator<Item = Self::Item>;
}

/// Conversion into the items of a parallel loop.
pub(crate) trait IntoItems: Sized {
    /// Items.
    type Items: Items;
    /// Items.
    fn into_items(self) -> Self::Items;
}

impl<I: Items> IntoItems for I {
    type Items = I;

    #[inline(always)]
    fn into_items(self) -> I {
        self
    }
}

impl<'a, T: Sync> IntoItems for &'a Vec<T> {
    type Items = &'a [T];

    #[inline(always)]
    fn into_items(self) -> &'a [T] {
        self
    }
}

impl<'a, T: Send> IntoItems for &'a mut Vec<T> {
    type Items = &'a mut [T];

    #[inline(always)]
    fn into_items(self) -> &'a mut [T] {
        self
    }
}

impl<'a, T: Sync> Items for &'a [T] {
    type Item = &'a T;

    fn length(&self) -> usize {
        self.len()
    }

    fn divided(self, place: usize) -> (Self, Self) {
        self.split_at(place)
    }

    #[inline(always)]
    fn sequence(self) -> impl Iterator<Item = &'a T> {
        self.iter()
    }
}

impl<'a, T: Send> Items for &'a mut [T] {
    type Item = &'a mut T;

    fn length(&self) -> usize {
        self.len()
    }

    fn divided(self, place: usize) -> (Self, Self) {
        self.split_at_mut(place)
    }

    #[inline(always)]
    fn sequence(self) -> impl Iterator<Item = &'a mut T> {
        self.iter_mut()
    }
}

/// Chunks of a slice that is read.
#[derive(Debug)]
pub(crate) struct Chunks<'a, T> {
    values: &'a [T],
    size: usize,
}

/// Chunks of a slice that is written.
#[derive(Debug)]
pub(crate) struct ChunksMut<'a, T> {
    values: &'a mut [T],
    size: usize,
}

impl<'a, T: Sync> Items for Chunks<'a, T> {
    type Item = &'a [T];

    fn length(&self) -> usize {
        self.values.len().div_ceil(self.size)
    }

    fn divided(self, place: usize) -> (Self, Self) {
        let (values, later) = self.values.split_at((place * self.size).min(self.values.len()));
        (Self { values, ..self }, Self { values: later, ..self })
    }

    #[inline(always)]
    fn sequence(self) -> impl Iterator<Item = &'a [T]> {
        self.values.chunks(self.size)
    }
}

impl<'a, T: Send> Items for ChunksMut<'a, T> {
    type Item = &'a mut [T];

    fn length(&self) -> usize {
        self.values.len().div_ceil(self.size)
    }

    fn divided(self, place: usize) -> (Self, Self) {
        let (size, end) = (self.size, (place * self.size).min(self.values.len()));
        let (values, later) = self.values.split_at_mut(end);
        (Self { values, size }, Self { values: later, size })
    }

    #[inline(always)]
    fn sequence(self) -> impl Iterator<Item = &'a mut [T]> {
        self.values.chunks_mut(self.size)
    }
}

/// Slices that the loops read.
pub(crate) trait ParallelSlice<T> {
    /// Chunks of `size` values; the last may have fewer. Panics if `size` is zero.
    fn par_chunks(&self, size: usize) -> Chunks<'_, T>;
}

impl<T> ParallelSlice<T> for [T] {
    fn par_chunks(&self, size: usize) -> Chunks<'_, T> {
        assert!(size > 0, "chunks without values");
        Chunks { values: self, size }
    }
}

/// Slices that loops write.
pub(crate) trait ParallelSliceMut<T> {
    /// Chunks of `size` values; the last may have fewer. Panics if `size` is zero.
    fn par_chunks_mut(&mut self, size: usize) -> ChunksMut<'_, T>;
    /// The values one by one.
    fn par_iter_mut(&mut self) -> &mut [T];
}

impl<T> ParallelSliceMut<T> for [T] {
    fn par_chunks_mut(&mut self, size: usize) -> ChunksMut<'_, T> {
        assert!(size > 0, "chunks without values");
        ChunksMut { values: self, size }
    }

    fn par_iter_mut(&mut self) -> &mut [T] {
        self
    }
}

/// Items with their numbers.
#[derive(Debug)]
pub(crate) struct Enumerated<I> {
    pub(super) items: I,
    pub(super) first: usize,
}

impl<I: Items> Items for Enumerated<I> {
    type Item = (usize, I::Item);

    fn length(&self) -> usize {
        self.items.length()
    }

    fn divided(self, place: usize) -> (Self, Self) {
        let (items, later) = self.items.divided(place);
        (Self { items, first: self.first }, Self { items: later, first: self.first + place })
    }

    #[inline(always)]
    fn sequence(self) -> impl Iterator<Item = Self::Item> {
        (self.first..).zip(self.items.sequence())
    }
}

/// Items, or none as often as they are wanted.
impl<I: Items> Items for Option<I> {
    type Item = Option<I::Item>;

    fn length(&self) -> usize {
        self.as_ref().map_or(usize::MAX, I::length)
    }

    fn divided(self, place: usize) -> (Self, Self) {
        self.map(|items| items.divided(place)).unzip()
    }

    #[inline(always)]
    fn sequence(self) -> impl Iterator<Item = Self::Item> {
        let mut items = self.map(I::sequence);
        std::iter::from_fn(move || match &mut items {
            Some(items) => items.next().map(Some),
            None => Some(None),
        })
    }
}

/// Items side by side, as many as the shortest has.
#[derive(Debug)]
pub(crate) struct Zipped<Z>(Z);

macro_rules! zipped {
    ($($type:ident $items:ident),+; $sequence:expr; $nested:pat) => {
        impl<$($type: IntoItems),+> IntoItems for ($($type,)+) {
            type Items = Zipped<($($type::Items,)+)>;

            #[inline(always)]
            fn into_items(self) -> Self::Items {
                let ($($items,)+) = self;
                Zipped(($($items.into_items(),)+))
            }
        }

        impl<$($type: Items),+> Items for Zipped<($($type,)+)> {
            type Item = ($($type::Item,)+);

            fn length(&self) -> usize {
                let ($($items,)+) = &self.0;
                let mut least = usize::MAX;
                $(least = least.min($items.length());)+
                least
            }

            fn divided(self, place: usize) -> (Self, Self) {
                let ($($items,)+) = self.0;
                $(let $items = $items.divided(place);)+
                (Self(($($items.0,)+)), Self(($($items.1,)+)))
            }

            #[inline(always)]
            fn sequence(self) -> impl Iterator<Item = Self::Item> {
                let ($($items,)+) = self.0;
                $(let $items = $items.sequence();)+
                $sequence.map(|$nested| ($($items,)+))
            }
        }
    };
}
zipped!(A a, B b; a.zip(b); (a, b));
zipped!(A a, B b, C c; a.zip(b).zip(c); ((a, b), c));
zipped!(A a, B b, C c, D d; a.zip(b).zip(c).zip(d); (((a, b), c), d));
zipped!(A a, B b, C c, D d, E e; a.zip(b).zip(c).zip(d).zip(e); ((((a, b), c), d), e));
zipped!(A a, B b, C c, D d, E e, F f; a.zip(b).zip(c).zip(d).zip(e).zip(f); (((((a, b), c), d), e), f));
zipped!(
    A a, B b, C c, D d, E e, F f, G g;
    a.zip(b).zip(c).zip(d).zip(e).zip(f).zip(g);
    ((((((a, b), c), d), e), f), g)
);
