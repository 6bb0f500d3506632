use super::*;
use proptest::prelude::*;

fn value() -> impl Strategy<Value = Value> {
    let number = prop_oneof![(-1_000_000_i64..1_000_000).prop_map(|whole| whole as f64), -1e6..1e6_f64];
    prop_oneof![
        "[a-z][a-z_.0-9-]{0,12}".prop_map(Value::from),
        any::<f64>().prop_map(Value::from),
        any::<usize>().prop_map(Value::from),
        any::<u64>().prop_map(Value::from),
        number.clone().prop_map(Value::from),
        (number.clone(), number.clone()).prop_map(|(lower, upper)| Value::from(format!("{lower}..{upper}"))),
        prop::collection::vec(number, 1..4).prop_map(Value::list),
        // what somebody calls a material
        any::<String>().prop_map(Value::from),
    ]
}

fn variant() -> impl Strategy<Value = Variant> {
    prop::collection::btree_map("[a-z][a-z_]{0,8}", value(), 0..5)
        .prop_map(|parts| parts.into_iter().fold(Variant::default(), |variant, (key, value)| variant.and(&key, value)))
}

proptest! {
    #[test]
    fn a_variant_is_read_back_from_its_text(variant in variant()) {
        prop_assert_eq!(variant.to_string().parse(), Ok(variant.clone()));
        let json = serde_json::to_string(&variant).expect("serialises");
        prop_assert_eq!(serde_json::from_str::<Variant>(&json).expect("reads back"), variant);
    }

    #[test]
    fn a_text_that_is_read_is_written_as_it_was(text in "[a-z0-9=,._-]{0,20}") {
        if let Ok(variant) = text.parse::<Variant>() {
            prop_assert_eq!(variant.to_string(), text);
        }
    }
}

#[test]
fn values_have_their_types_and_keys_their_order() {
    let text = "material=mu_i,slope=0.03,resolution=10_20_40,height=0.5..3,rows=12,start=profile_24,shift=-2";
    let variant: Variant = text.parse().expect("a variant");
    assert_eq!(variant.to_string(), text);
    let keys: Vec<&str> = variant.parts().map(|(key, _)| key).collect();
    assert_eq!(keys, ["material", "slope", "resolution", "height", "rows", "start", "shift"]);
    assert_eq!(variant.get("material").map(Value::text), Some("mu_i"));
    assert_eq!(variant.get("slope"), Some(&Value::from(0.03)));
    assert_eq!(variant.get("resolution"), Some(&Value::list([10_usize, 20, 40])));
    assert_eq!(variant.get("resolution").map(|value| value.joined().len()), Some(3));
    assert_eq!(variant.get("height").and_then(Value::range), Some(0.5..=3.0));
    assert_eq!(variant.get("rows").and_then(Value::number), Some(12.0));
    assert_eq!(variant.get("start").map(|value| value.joined().len()), Some(1));
    assert_eq!(variant.get("shift"), Some(&Value::from(-2)));
    assert_eq!(variant.get("spacing"), None);
}

#[test]
fn a_join_is_no_range_and_equal_numbers_are_equal_whatever_their_type() {
    assert_eq!(Value::list([3.0, 8.0]).range(), None);
    assert_eq!(Value::from(1.0), Value::from(1_usize));
    assert_eq!(Value::from(-0.0), Value::from(0));
    assert_eq!(Value::list([0.03]), Value::from(0.03));
    assert_eq!(Variant::of("slope", 1.0), "slope=1".parse().expect("a variant"));
    assert_eq!(Value::from("a=b,c"), Value::from("a-b-c"));
}

#[test]
fn file_names_are_letters_digits_points_and_dashes() {
    let variant: Variant = "slope_angle=24,start=rest,height=0.5..3".parse().expect("a variant");
    assert_eq!(variant.file_name(), "slope-angle-24-start-rest-height-0.5-3");
    assert_eq!(variant.file_name_of_values(), "24-rest-0.5-3");
    assert_eq!(Variant::of("variant", "<b>x/µ").file_name(), "variant--b-x--");
    assert_eq!(Variant::default().file_name(), "");
}

#[test]
fn invalid_variant_is_refused_with_its_part() {
    for (text, part) in [("resolution", "resolution"), ("a=1,", ""), ("=1", "=1"), ("a=", "a="), ("a=1=2", "a=1=2")] {
        let wrong = format!("`{text}` must be `key=value,key=value`, but has the part `{part}`");
        assert_eq!(text.parse::<Variant>(), Err(wrong));
    }
    let wrong = "`a=1,a=2` must be `key=value,key=value`, but has `a` twice";
    assert_eq!("a=1,a=2".parse::<Variant>(), Err(wrong.to_owned()));
}
