//! `helixlock._native`: the functions of the command, answering Python.
//!
//! Results are the JSON of the command, as text that Python reads; samples are Arrow tables over
//! the very memory they were worked out in.

mod samples;

use std::ffi::OsString;

use helixlock::{Answer, Part, Refused, functions};
use pyo3::create_exception;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::samples::{Column, Table};

create_exception!(helixlock, Error, PyValueError, "Input that was refused, and its place.");

/// The compiled part of `helixlock`.
#[pymodule]
mod _native {
    #[pymodule_export]
    use super::{Column, Error, Table, answer};
}

/// What a function answers to the words of its command: JSON, and tables and texts by name.
#[pyfunction]
fn answer<'py>(
    py: Python<'py>,
    function: &str,
    words: Vec<OsString>,
) -> PyResult<(String, Bound<'py, PyDict>)> {
    let Some(function) = functions().iter().find(|known| known.name == function) else {
        return Err(PyValueError::new_err(format!("no function `{function}`")));
    };
    let answered = py.detach(|| function.answer(words));
    let Answer { json, parts } = answered.map_err(|refused| raised(py, refused))?;
    let named = PyDict::new(py);
    for (name, part) in parts {
        match part {
            Part::Table(table) => named.set_item(name, Table::new(table)?)?,
            Part::Text(text) => named.set_item(name, text)?,
        }
    }
    Ok((json.to_string(), named))
}

/// The exception, with the place as attributes.
fn raised(py: Python<'_>, refused: Refused) -> PyErr {
    let Refused { message, file, line, column, key } = refused;
    let error = Error::new_err(message);
    let value = error.value(py);
    let set = value
        .setattr("file", file)
        .and_then(|()| value.setattr("line", line))
        .and_then(|()| value.setattr("column", column))
        .and_then(|()| value.setattr("key", key));
    match set {
        Ok(()) => error,
        Err(other) => other,
    }
}
