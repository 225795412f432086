//! The elements of accessors. All elements must lie within the view, and the view within its buffer.

use std::borrow::Cow;

use super::document::{Accessor, Document, Values, entry};
use crate::error::Fault;
use crate::number::Number;
use crate::text::quote;

/// The elements of an accessor.
pub(super) struct Elements<'a> {
    pub(super) count: usize,
    /// Without a view, all elements are 0.
    plain: Option<Plain<'a>>,
    /// Replacements of elements, in order.
    sparse: Vec<(usize, &'a [u8])>,
    component: Component,
    is_normalized: bool,
}

/// Elements in a view.
#[derive(Clone, Copy)]
struct Plain<'a> {
    data: &'a [u8],
    stride: usize,
    size: usize,
}

/// A zero element of any supported type.
const ZERO: [u8; 16] = [0; 16];

/// The type of a component.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

/// The purpose of an accessor.
#[derive(Clone, Copy)]
pub(super) enum Use {
    /// Positions, translations or scales.
    Vectors,
    /// Quaternions.
    Rotations,
    /// Corners of triangles.
    Indices,
}

/// A document, with the bytes of its buffers.
#[derive(Clone, Copy)]
pub(super) struct Store<'a> {
    pub(super) document: &'a Document,
    pub(super) buffers: &'a [Cow<'a, [u8]>],
}

impl<'a> Store<'a> {
    /// Returns the elements of an accessor with a purpose.
    pub(super) fn elements(self, index: usize, what: Use) -> Result<Elements<'a>, Fault> {
        let accessor = entry(&self.document.accessors, index, "accessor")?;
        let faulty = |found: String, expected: &str| Fault::unexpected(format!("accessor {index} {found}"), expected);
        let (shape, numbers) = match what {
            Use::Vectors => ("VEC3", 3),
            Use::Rotations => ("VEC4", 4),
            Use::Indices => ("SCALAR", 1),
        };
        if accessor.shape != shape {
            return Err(faulty(format!("of type {}", quote(&accessor.shape)), shape));
        }
        let component = Component::of(accessor.component_type);
        let is_index = |component: &Component| matches!(component, Component::U8 | Component::U16 | Component::U32);
        let component = match what {
            Use::Indices => component.filter(is_index),
            _ => component.filter(|component| *component != Component::U32),
        };
        let component = component.ok_or_else(|| {
            let expected = match what {
                Use::Indices => "5121, 5123 or 5125, which have no sign",
                _ => "5126 (float), or 5120 to 5123 (short integers)",
            };
            faulty(format!("of component type {}", accessor.component_type), expected)
        })?;
        let size = numbers * component.size();
        let place = format!("accessor {index}");
        let plain = |values: &Values, count, size| self.plain(&place, values, count, size);
        let base = match accessor.buffer_view {
            None => None,
            Some(buffer_view) => {
                let values = Values { buffer_view, byte_offset: accessor.byte_offset, component_type: 0 };
                Some(plain(&values, accessor.count, size)?)
            }
        };
        let sparse = match &accessor.sparse {
            None => Vec::new(),
            Some(sparse) => {
                let index = Component::of(sparse.indices.component_type).filter(is_index);
                let index = index.ok_or_else(|| {
                    let found = format!("with sparse indices of component type {}", sparse.indices.component_type);
                    faulty(found, "5121, 5123 or 5125, which have no sign")
                })?;
                let indices = plain(&sparse.indices, sparse.count, index.size())?;
                let values = plain(&sparse.values, sparse.count, size)?;
                (0..sparse.count).map(|i| (index.whole(indices.get(i)) as usize, values.get(i))).collect()
            }
        };
        let in_order = sparse.windows(2).all(|pair| pair[0].0 < pair[1].0);
        if !in_order || sparse.last().is_some_and(|(last, _)| *last >= accessor.count) {
            let expected = format!("them in order, each less than {}", accessor.count);
            return Err(faulty("with sparse indices out of order or out of range".into(), &expected));
        }
        self.check_data(accessor).map_err(|(found, expected)| faulty(found, &expected))?;
        let is_normalized = accessor.normalized;
        Ok(Elements { count: accessor.count, plain: base, sparse, component, is_normalized })
    }

    /// Limits the number of elements without a view, which no bytes limit.
    fn check_data(self, accessor: &Accessor) -> Result<(), (String, String)> {
        let most: usize = self.buffers.iter().map(|bytes| bytes.len()).sum();
        match (&accessor.buffer_view, &accessor.sparse) {
            (None, None) => Err(("without data".into(), "a buffer view or sparse values, not compressed".into())),
            (None, Some(_)) if accessor.count > most => {
                Err((format!("of {} elements without data", accessor.count), format!("up to {most}, as many as bytes")))
            }
            _ => Ok(()),
        }
    }

    /// Returns `count` elements of a view.
    fn plain(self, place: &str, values: &Values, count: usize, size: usize) -> Result<Plain<'a>, Fault> {
        let view = entry(&self.document.buffer_views, values.buffer_view, "buffer view")?;
        let buffer: &'a [u8] = entry(self.buffers, view.buffer, "buffer")?;
        let end = view.byte_offset.checked_add(view.byte_length).filter(|&end| end <= buffer.len());
        let outside = |what: String, most: usize| Fault::unexpected(what, format!("an end within its {most} bytes"));
        let data = end.map(|end| &buffer[view.byte_offset..end]).ok_or_else(|| {
            outside(format!("buffer view {} beyond buffer {}", values.buffer_view, view.buffer), buffer.len())
        })?;
        let stride = view.byte_stride.unwrap_or(size);
        if stride < size {
            return Err(Fault::unexpected(
                format!("{place} with a stride of {stride}"),
                format!("at least {size} bytes"),
            ));
        }
        let needed = count.saturating_sub(1).checked_mul(stride).and_then(|last| last.checked_add(size));
        let data = data.get(values.byte_offset..).filter(|data| count == 0 || needed.is_some_and(|n| n <= data.len()));
        let beyond = || outside(format!("{place} beyond buffer view {}", values.buffer_view), view.byte_length);
        Ok(Plain { data: data.ok_or_else(beyond)?, stride, size })
    }
}

impl<'a> Plain<'a> {
    fn get(&self, index: usize) -> &'a [u8] {
        &self.data[index * self.stride..][..self.size]
    }
}

impl<'a> Elements<'a> {
    /// Returns the bytes of each element.
    fn bytes(&self) -> impl Iterator<Item = &'a [u8]> {
        let mut sparse = self.sparse.iter().peekable();
        (0..self.count).map(move |i| match sparse.next_if(|(at, _)| *at == i) {
            Some((_, bytes)) => *bytes,
            None => self.plain.map_or(&ZERO[..], |plain| plain.get(i)),
        })
    }

    /// Returns the `N` components of each element.
    pub(super) fn numbers<const N: usize>(&self) -> impl Iterator<Item = [Number<f64>; N]> {
        let size = self.component.size();
        self.bytes().map(move |bytes| {
            std::array::from_fn(|i| self.component.number(&bytes[i * size..][..size], self.is_normalized))
        })
    }

    /// Returns the index in each element.
    pub(super) fn indices(&self) -> impl Iterator<Item = u32> {
        self.bytes().map(|bytes| self.component.whole(bytes))
    }
}

impl Component {
    fn of(number: u32) -> Option<Self> {
        Some(match number {
            5120 => Self::I8,
            5121 => Self::U8,
            5122 => Self::I16,
            5123 => Self::U16,
            5125 => Self::U32,
            5126 => Self::F32,
            _ => return None,
        })
    }

    fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::U32 | Self::F32 => 4,
        }
    }

    /// Converts little-endian bytes to an integer.
    fn whole(self, bytes: &[u8]) -> u32 {
        bytes[..self.size()].iter().rev().fold(0, |number, &byte| number << 8 | u32::from(byte))
    }

    /// Converts bytes to a number. A normalised integer is divided by its greatest value (`KHR_mesh_quantization`).
    fn number(self, bytes: &[u8], is_normalized: bool) -> Number<f64> {
        let bits = self.whole(bytes);
        let (value, most) = match self {
            Self::I8 => (f64::from(bits as i8), 127.0),
            Self::U8 => (f64::from(bits), 255.0),
            Self::I16 => (f64::from(bits as i16), 32_767.0),
            Self::U16 => (f64::from(bits), 65_535.0),
            Self::U32 => (f64::from(bits), 4_294_967_295.0),
            Self::F32 => return Number::exact(f64::from(f32::from_bits(bits))),
        };
        if !is_normalized {
            return Number::exact(value);
        }
        // The least value, such as -128, counts as -127.
        let value = value.max(-most);
        let part = value / most;
        Number { value: part, error: part.mul_add(-most, value).abs() / most }
    }
}
