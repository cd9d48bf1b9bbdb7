//! Samples for Python by the Arrow C data interface and numpy's array interface: nothing is copied.

use std::sync::Arc;

use arrow_array::ffi::{FFI_ArrowArray, FFI_ArrowSchema, to_ffi};
use arrow_array::ffi_stream::FFI_ArrowArrayStream;
use arrow_array::{Array, ArrayRef, Float64Array, RecordBatch, RecordBatchIterator};
use arrow_schema::{ArrowError, DataType, Field, Schema};
use pyo3::exceptions::{PyIndexError, PyKeyError, PyRuntimeError};
use pyo3::prelude::*;
use pyo3::types::{PyCapsule, PyDict};

/// Samples: named columns of numbers, each name ending in the unit. A missing value is NaN.
///
/// `pandas.DataFrame.from_arrow`, `polars.DataFrame`, `pyarrow.table` and all that reads the Arrow
/// C stream interface take it without a copy; `numpy.asarray(table["time_s"])` too.
#[pyclass(frozen, module = "helixlock")]
pub(crate) struct Table(RecordBatch);

impl Table {
    pub(crate) fn new(table: helixlock::Table) -> PyResult<Self> {
        let (fields, columns): (Vec<Field>, Vec<ArrayRef>) = table
            .columns
            .into_iter()
            .map(|column| {
                let values = Float64Array::from(column.values);
                (Field::new(column.name, DataType::Float64, false), Arc::new(values) as ArrayRef)
            })
            .unzip();
        RecordBatch::try_new(Arc::new(Schema::new(fields)), columns).map(Self).map_err(failed)
    }
}

#[pymethods]
impl Table {
    /// Names of the columns.
    #[getter]
    fn columns(&self) -> Vec<String> {
        self.0.schema_ref().fields().iter().map(|field| field.name().clone()).collect()
    }

    fn __len__(&self) -> usize {
        self.0.num_rows()
    }

    fn __getitem__(&self, name: &str) -> PyResult<Column> {
        let column = self.0.column_by_name(name).and_then(|column| column.as_any().downcast_ref());
        let missing = || PyKeyError::new_err(format!("{name}, there are {:?}", self.columns()));
        column.cloned().map(Column).ok_or_else(missing)
    }

    fn __repr__(&self) -> String {
        format!("<helixlock.Table, {} rows of {}>", self.0.num_rows(), self.columns().join(", "))
    }

    /// The Arrow C stream interface; other types than those of the columns are not made.
    #[pyo3(signature = (requested_schema=None))]
    fn __arrow_c_stream__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyCapsule>> {
        let _ = requested_schema;
        let batches = RecordBatchIterator::new([Ok(self.0.clone())], self.0.schema());
        let stream = FFI_ArrowArrayStream::new(Box::new(batches));
        PyCapsule::new_with_value(py, stream, c"arrow_array_stream")
    }
}

/// One column of a table.
#[pyclass(frozen, module = "helixlock")]
pub(crate) struct Column(Float64Array);

#[pymethods]
impl Column {
    fn __len__(&self) -> usize {
        self.0.len()
    }

    fn __getitem__(&self, place: isize) -> PyResult<f64> {
        let values = self.0.values();
        let from_end = values.len().checked_add_signed(place).filter(|_| place < 0);
        let place = from_end.or(usize::try_from(place).ok());
        let value = place.and_then(|place| values.get(place)).copied();
        value.ok_or_else(|| PyIndexError::new_err("column index out of range"))
    }

    fn __repr__(&self) -> String {
        format!("<helixlock.Column, {} numbers>", self.0.len())
    }

    /// numpy's array interface, for reading only.
    #[getter]
    fn __array_interface__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let interface = PyDict::new(py);
        interface.set_item("version", 3)?;
        interface.set_item("shape", (self.0.len(),))?;
        interface
            .set_item("typestr", if cfg!(target_endian = "little") { "<f8" } else { ">f8" })?;
        interface.set_item("data", (self.0.values().as_ptr().addr(), true))?;
        Ok(interface)
    }

    /// The Arrow C array interface; another type than that of the column is not made.
    #[pyo3(signature = (requested_schema=None))]
    fn __arrow_c_array__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<(Bound<'py, PyCapsule>, Bound<'py, PyCapsule>)> {
        let _ = requested_schema;
        let (array, schema): (FFI_ArrowArray, FFI_ArrowSchema) =
            to_ffi(&self.0.to_data()).map_err(failed)?;
        Ok((
            PyCapsule::new_with_value(py, schema, c"arrow_schema")?,
            PyCapsule::new_with_value(py, array, c"arrow_array")?,
        ))
    }
}

#[expect(clippy::needless_pass_by_value, reason = "the shape of map_err")]
fn failed(error: ArrowError) -> PyErr {
    PyRuntimeError::new_err(error.to_string())
}
