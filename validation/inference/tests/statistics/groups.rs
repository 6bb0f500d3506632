//! Groups of items with the same key.

use bagnold_inference::statistics::grouped;

#[test]
fn items_of_a_key_come_together_in_their_order() {
    assert_eq!(grouped([("b", 1), ("a", 2), ("b", 3)]), [("b", vec![1, 3]), ("a", vec![2])]);
    assert_eq!(grouped::<u8, u8>([]), []);
}
