//! The value of a key: a word, a number, several of them, or a range.

use std::fmt;
use std::ops::RangeInclusive;

/// Whole numbers up to this size are themselves as `f64`.
const LARGEST_WHOLE: f64 = 9_007_199_254_740_992.0;

/// Value of a key of a variant. It is built by `From`, which gives one form to each text: 1 and 1.0 are the same
/// integer, and a word that reads as a number is one.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// A name: `rest`, `herschel_bulkley`.
    Word(String),
    /// A whole number: `40`.
    Integer(i64),
    /// Any other finite number: `0.03`.
    Number(f64),
    /// From the first to the second: `3..8`.
    Range(f64, f64),
    /// Numbers of several runs: `10_20_40`.
    List(Vec<Value>),
}

// finite numbers only, so that every value equals itself
impl Eq for Value {}

impl Value {
    /// The number, of an integer as well.
    #[must_use]
    pub fn number(&self) -> Option<f64> {
        match self {
            #[expect(clippy::cast_precision_loss, reason = "larger integers are no counts of ours")]
            Self::Integer(number) => Some(*number as f64),
            Self::Number(number) => Some(*number),
            _ => None,
        }
    }

    /// The name.
    #[must_use]
    pub fn word(&self) -> Option<&str> {
        match self {
            Self::Word(word) => Some(word),
            _ => None,
        }
    }

    /// The values that are joined; a value that joins nothing is alone.
    #[must_use]
    pub fn joined(&self) -> &[Self] {
        match self {
            Self::List(values) => values,
            _ => std::slice::from_ref(self),
        }
    }

    /// Several numbers as one value: the number itself if there is one only.
    pub fn list(numbers: impl IntoIterator<Item = impl Into<Self>>) -> Self {
        let text: Vec<String> = numbers.into_iter().map(|number| number.into().to_string()).collect();
        Self::from(text.join("_").as_str())
    }
}

fn number_in(text: &str) -> Option<Value> {
    let number = text.parse::<f64>().ok().filter(|number| number.is_finite())?;
    // a text that would be written in another way, such as `1e3`, stays the word that it is
    Some(Value::from(number)).filter(|value| value.to_string() == text)
}

fn range_in(text: &str) -> Option<Value> {
    let (lower, upper) = text.split_once("..")?;
    Some(Value::Range(number_in(lower)?.number()?, number_in(upper)?.number()?))
}

fn list_in(text: &str) -> Option<Value> {
    let values: Option<Vec<Value>> = text.split('_').map(number_in).collect();
    values.filter(|values| values.len() > 1).map(Value::List)
}

/// Value that a text reads as; `=` and `,`, which separate the keys, become dashes.
impl From<&str> for Value {
    fn from(text: &str) -> Self {
        let read = number_in(text).or_else(|| range_in(text)).or_else(|| list_in(text));
        read.unwrap_or_else(|| match text {
            "" => Self::Word("-".to_owned()),
            _ => Self::Word(text.replace(['=', ','], "-")),
        })
    }
}

impl From<String> for Value {
    fn from(text: String) -> Self {
        Self::from(text.as_str())
    }
}

impl From<&String> for Value {
    fn from(text: &String) -> Self {
        Self::from(text.as_str())
    }
}

impl From<f64> for Value {
    fn from(number: f64) -> Self {
        match number {
            whole if whole.trunc() == whole && whole.abs() < LARGEST_WHOLE => Self::Integer(whole as i64),
            finite if finite.is_finite() => Self::Number(finite),
            other => Self::Word(other.to_string()),
        }
    }
}

impl From<usize> for Value {
    fn from(count: usize) -> Self {
        Self::from(count as f64)
    }
}

impl From<i32> for Value {
    fn from(count: i32) -> Self {
        Self::Integer(count.into())
    }
}

impl From<u64> for Value {
    fn from(count: u64) -> Self {
        Self::from(count as f64)
    }
}

impl From<RangeInclusive<f64>> for Value {
    fn from(range: RangeInclusive<f64>) -> Self {
        Self::from(format!("{}..{}", range.start(), range.end()))
    }
}

impl fmt::Display for Value {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Word(word) => formatter.write_str(word),
            Self::Integer(number) => write!(formatter, "{number}"),
            Self::Number(number) => write!(formatter, "{number}"),
            Self::Range(lower, upper) => write!(formatter, "{lower}..{upper}"),
            Self::List(values) => {
                let text: Vec<String> = values.iter().map(Self::to_string).collect();
                formatter.write_str(&text.join("_"))
            }
        }
    }
}
