//! Arrays of any strides from Python, read row by row.

use std::ops::Range;

use numpy::ndarray::ArrayView2;
use numpy::{PyReadonlyArray1, PyReadonlyArray2, PyUntypedArray};
use pyo3::prelude::*;
use stackless_bvh::geom::{Mesh, Ray, Vector};

use crate::batch::PIECE;
use crate::errors::{failed, index_message, of_mesh, of_ray, refused};
use crate::memory::room;
use crate::space::Space;
use crate::threads::{FEW, Threads, of_each};

/// Rays as four arrays: `origins` and `directions` of shape (n, 3), `tmin` and `tmax` of shape (n,).
pub(crate) struct Rays<'py, S: Space> {
    origins: PyReadonlyArray2<'py, S::Real>,
    directions: PyReadonlyArray2<'py, S::Real>,
    tmin: PyReadonlyArray1<'py, S::Real>,
    tmax: PyReadonlyArray1<'py, S::Real>,
    count: usize,
    places: Vec<Place<'py>>,
}

impl<'py, S: Space> Rays<'py, S> {
    /// Checks that the arrays have equal lengths.
    pub(crate) fn new(arrays: [&Bound<'py, PyAny>; 4]) -> PyResult<Self> {
        let [origins, directions, tmin, tmax] = arrays;
        let (origins, directions) = (points::<S>(origins, "origins")?, points::<S>(directions, "directions")?);
        let (tmin, tmax) = (numbers::<S>(tmin, "tmin")?, numbers::<S>(tmax, "tmax")?);
        let count = origins.as_array().nrows();
        let counts = [directions.as_array().nrows(), tmin.as_array().len(), tmax.as_array().len()];
        if counts != [count; 3] {
            return Err(refused(format!("{count} origins, but directions, tmin and tmax have {counts:?} rows")));
        }
        let names = ["origins", "directions", "tmin", "tmax"];
        Ok(Self { origins, directions, tmin, tmax, count, places: places(count, arrays, names)? })
    }

    pub(crate) fn len(&self) -> usize {
        self.count
    }

    /// Some of the rays.
    pub(crate) fn chunk(&self, threads: &Threads, rows: Range<usize>) -> PyResult<Vec<Ray<S::Vector>>> {
        Ok(self.chunks(threads, rows)?.chunks.into_iter().flatten().collect())
    }

    /// Some of the rays, [`FEW`] at a time.
    pub(crate) fn chunks(&self, threads: &Threads, rows: Range<usize>) -> PyResult<Chunks<S>> {
        check_places(&self.places)?;
        let (origins, directions) = (self.origins.as_array(), self.directions.as_array());
        // Without gaps, as in most arrays, rows are read faster.
        let packed = [&origins, &directions].map(|array| array.as_slice().map(|numbers| numbers.as_chunks::<3>().0));
        let (tmin, tmax) = (self.tmin.as_array(), self.tmax.as_array());
        let vector = S::Vector::from_components;
        // Runs on all threads. This thread holds the interpreter's lock, so the arrays do not change.
        let chunk = |first: usize| {
            let rows = first..rows.end.min(first + FEW);
            let rays = if let [Some(origins), Some(directions)] = packed {
                Ray::collect(rows.map(|row| (vector(origins[row]), vector(directions[row]), tmin[row], tmax[row])))
            } else {
                let vector = |array, row| vector(row_of(array, row));
                Ray::collect(rows.map(|row| (vector(&origins, row), vector(&directions, row), tmin[row], tmax[row])))
            };
            rays.map_err(|(i, error)| (first + i, error))
        };
        let chunks = threads.run(|| of_each(rows.clone().step_by(FEW), chunk));
        let chunks = chunks.into_iter().collect::<Result<_, _>>().map_err(|(row, error)| of_ray(error, row))?;
        Ok(Chunks { rows, chunks })
    }
}

/// Rays of a range of rows, [`FEW`] at a time.
pub(crate) struct Chunks<S: Space> {
    pub(crate) rows: Range<usize>,
    pub(crate) chunks: Vec<Vec<Ray<S::Vector>>>,
}

/// The address of an array. `resize(refcheck=False)` moves an array under all its views, and `NumPy` does not report it.
pub(crate) struct Place<'py> {
    name: &'static str,
    /// The array that owns the memory; the other array may be a view of it.
    owner: Bound<'py, PyAny>,
    /// Address and bytes.
    found: (usize, usize),
}

impl Place<'_> {
    fn of(owner: &Bound<'_, PyAny>) -> PyResult<(usize, usize)> {
        let address = owner.getattr("__array_interface__")?.get_item("data")?.get_item(0)?.extract()?;
        Ok((address, owner.getattr("nbytes")?.extract()?))
    }
}

/// Records the places of arrays with `count` rows. Python runs between pieces, so one piece needs no record.
pub(crate) fn places<'py, const N: usize>(
    count: usize,
    arrays: [&Bound<'py, PyAny>; N],
    names: [&'static str; N],
) -> PyResult<Vec<Place<'py>>> {
    let place = |(array, name): (&Bound<'py, PyAny>, _)| {
        let mut owner = array.clone();
        while let Ok(base) = owner.getattr("base")?.cast_into::<PyUntypedArray>() {
            owner = base.into_any();
        }
        Ok(Place { name, found: Place::of(&owner)?, owner })
    };
    if count <= PIECE { Ok(Vec::new()) } else { arrays.into_iter().zip(names).map(place).collect() }
}

/// Refuses arrays whose memory has moved.
pub(crate) fn check_places(places: &[Place<'_>]) -> PyResult<()> {
    for Place { name, owner, found } in places {
        if Place::of(owner)? != *found {
            return Err(failed(format!("{name}: resized while it was read, expected an array that stays as it is")));
        }
    }
    Ok(())
}

/// An array of shape (n, 3), with the number type of a scene.
pub(crate) fn points<'py, S: Space>(array: &Bound<'py, PyAny>, name: &str) -> PyResult<PyReadonlyArray2<'py, S::Real>> {
    let unfit = || refused(format!("{name}: expected an array of {} of shape (n, 3)", S::DTYPE));
    check_aligned(array, name)?;
    let array: PyReadonlyArray2<'py, S::Real> = array.extract().map_err(|_| unfit())?;
    if array.as_array().ncols() == 3 { Ok(array) } else { Err(unfit()) }
}

/// An array of shape (n,), with the number type of a scene.
pub(crate) fn numbers<'py, S: Space>(
    array: &Bound<'py, PyAny>,
    name: &str,
) -> PyResult<PyReadonlyArray1<'py, S::Real>> {
    check_aligned(array, name)?;
    array.extract().map_err(|_| refused(format!("{name}: expected an array of {} of shape (n,)", S::DTYPE)))
}

/// Refuses unaligned arrays, which would be read wrongly. The Python modules copy such arrays.
pub(crate) fn check_aligned(array: &Bound<'_, PyAny>, name: &str) -> PyResult<()> {
    let is_aligned = array.getattr("flags").and_then(|flags| flags.getattr("aligned")?.extract());
    if is_aligned.unwrap_or(true) { Ok(()) } else { Err(refused(format!("{name}: expected an aligned array"))) }
}

/// Three numbers of a row. Rows have at least three numbers.
pub(crate) fn row_of<T: Copy>(array: &ArrayView2<'_, T>, row: usize) -> [T; 3] {
    [array[[row, 0]], array[[row, 1]], array[[row, 2]]]
}

/// The mesh from arrays of vertices, shape (n, 3), and of faces, shape (m, 3).
pub(crate) fn mesh<S: Space>(vertices: &Bound<'_, PyAny>, faces: &Bound<'_, PyAny>) -> PyResult<Mesh<S::Vector>> {
    let vertices = vertices_of::<S>(vertices)?;
    check_aligned(faces, "faces")?;
    let faces = if let Ok(faces) = faces.extract::<PyReadonlyArray2<'_, i64>>() {
        faces_of(&faces.as_array(), vertices.len())?
    } else if let Ok(faces) = faces.extract::<PyReadonlyArray2<'_, i32>>() {
        faces_of(&faces.as_array(), vertices.len())?
    } else if let Ok(faces) = faces.extract::<PyReadonlyArray2<'_, u32>>() {
        faces_of(&faces.as_array(), vertices.len())?
    } else {
        return Err(refused("faces: expected an array of int32, int64 or uint32 of shape (m, 3)"));
    };
    mesh_of::<S>(vertices, faces)
}

/// A mesh; errors name the row.
pub(crate) fn mesh_of<S: Space>(vertices: Vec<S::Vector>, faces: Vec<[u32; 3]>) -> PyResult<Mesh<S::Vector>> {
    Mesh::new(vertices, faces).map_err(of_mesh)
}

/// The vertices of an array of shape (n, 3).
pub(crate) fn vertices_of<S: Space>(array: &Bound<'_, PyAny>) -> PyResult<Vec<S::Vector>> {
    let array = points::<S>(array, "vertices")?;
    let array = array.as_array();
    let mut vertices = room(array.nrows())?;
    vertices.extend((0..array.nrows()).map(|row| S::Vector::from_components(row_of(&array, row))));
    Ok(vertices)
}

/// Triples of indices below `vertices`.
fn faces_of<T: Copy + Into<i64>>(array: &ArrayView2<'_, T>, vertices: usize) -> PyResult<Vec<[u32; 3]>> {
    if array.ncols() != 3 {
        return Err(refused("faces: expected an array of integers of shape (m, 3)"));
    }
    let corner = |face: usize, corner: usize, index: i64| match u32::try_from(index) {
        Ok(index) if (index as usize) < vertices => Ok(index),
        _ => Err(refused(index_message(face, index, corner, vertices))),
    };
    let mut faces = room(array.nrows())?;
    for face in 0..array.nrows() {
        let [a, b, c] = row_of(array, face).map(Into::into);
        faces.push([corner(face, 0, a)?, corner(face, 1, b)?, corner(face, 2, c)?]);
    }
    Ok(faces)
}
