//! Items in groups.

/// Items with the same key together, groups and items in the order of their first one.
pub fn grouped<K: PartialEq, T>(items: impl IntoIterator<Item = (K, T)>) -> Vec<(K, Vec<T>)> {
    let mut groups: Vec<(K, Vec<T>)> = Vec::new();
    for (key, item) in items {
        match groups.iter_mut().find(|(own, _)| *own == key) {
            Some((_, own)) => own.push(item),
            None => groups.push((key, vec![item])),
        }
    }
    groups
}
