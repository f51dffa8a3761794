//! Columns as arrays.

use laneweave::Columns;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::values::array;

/// Arrays by the names of the columns of the table trajectories; lanelets are given by their places in the
/// list of all lanelets.
pub(crate) fn dict(py: Python<'_>, columns: Columns, has_poses: bool) -> PyResult<Bound<'_, PyDict>> {
    let dict = PyDict::new(py);
    dict.set_item("vehicle", array(py, columns.id))?;
    dict.set_item("lanelet_index", array(py, columns.lanelet))?;
    dict.set_item("position_m", array(py, columns.position_m))?;
    dict.set_item("speed_mps", array(py, columns.speed_mps))?;
    dict.set_item("acceleration_mps2", array(py, columns.acceleration_mps2))?;
    if has_poses {
        dict.set_item("x_m", array(py, columns.x_m))?;
        dict.set_item("y_m", array(py, columns.y_m))?;
        dict.set_item("z_m", array(py, columns.z_m))?;
        dict.set_item("heading_rad", array(py, columns.heading_rad))?;
    }
    Ok(dict)
}
