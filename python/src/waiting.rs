//! Work beside Python: the interpreter is free meanwhile, and Ctrl-C ends the work as it ends the program.

use bagnold_harness::input::escaped_lines;
use bagnold_harness::interruption;
use bagnold_harness::output::cautions;
use pyo3::create_exception;
use pyo3::exceptions::{PyKeyboardInterrupt, PyRuntimeError, PyUserWarning, PyValueError};
use pyo3::prelude::*;
use std::ffi::CString;
use std::fmt::Display;
use std::time::Duration;

create_exception!(
    bagnold,
    Refused,
    PyValueError,
    "Input that Bagnold refuses, or output that cannot be written: the text names file, field, value, rule and remedy."
);

/// Time after which a pressed Ctrl-C is seen, at the latest.
const PATIENCE: Duration = Duration::from_millis(20);

/// Does the work on a thread of its own, inside a pool of so many threads (one a core where none are named).
///
/// What is warned of for the first time becomes a `UserWarning`.
///
/// # Errors
/// What the work says, as [`Refused`]; a warning that Python makes an error; an exception of a signal handler, such as
/// `KeyboardInterrupt`, once the work has ended.
pub(crate) fn wait_for<T: Send, E: Display + Send>(
    py: Python<'_>,
    threads: Option<u16>,
    work: impl FnOnce() -> Result<T, E> + Send,
) -> PyResult<T> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads.unwrap_or(0).into())
        .build()
        .map_err(|error| Refused::new_err(format!("failed to start threads: {error}")))?;
    let told = cautions();
    let outcome = std::thread::scope(|scope| {
        let caller = std::thread::current();
        let worker = scope.spawn(move || {
            let outcome = pool.install(work);
            caller.unpark();
            outcome
        });
        let mut raised = None;
        while !worker.is_finished() {
            py.detach(|| std::thread::park_timeout(PATIENCE));
            if let Err(exception) = py.check_signals() {
                interruption::ask();
                raised = Some(exception);
            }
        }
        let interrupted = interruption::asked().is_some();
        if raised.is_some() {
            interruption::withdraw();
        }
        match (worker.join(), raised) {
            (_, Some(exception)) => Err(exception),
            // a run on another Python thread, which gets no signals of its own
            (Ok(Err(_)), None) if interrupted => Err(PyKeyboardInterrupt::new_err(())),
            (Ok(outcome), None) => {
                outcome.map_err(|error| Refused::new_err(escaped_lines(&error.to_string()).into_owned()))
            }
            (Err(_), None) => Err(PyRuntimeError::new_err("Bagnold has panicked; this is an error in Bagnold")),
        }
    })?;
    for (_, text) in cautions().into_iter().filter(|(subject, _)| !told.contains_key(subject)) {
        let text = CString::new(text).unwrap_or_default();
        PyErr::warn(py, &py.get_type::<PyUserWarning>(), &text, 1)?;
    }
    Ok(outcome)
}
