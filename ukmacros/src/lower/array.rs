//! Values: numbers, and arrays of numbers, which are vectors, matrices and families of any shape.

use crate::model::block;
use std::rc::Rc;
use ukalgebra::expr::{Graph, Id};

use super::bodies::{Frame, Point};
use super::parts::Joint;

/// Longer arrays are refused, and products of more terms: lists within lists grow fast.
pub(super) const MAX_ENTRIES: usize = 100_000;

#[derive(Clone)]
pub(super) enum Value {
    Scalar(Id),
    Array(Rc<Array>),
    /// A body, which only its methods and functions take.
    Body(Rc<Frame>),
    /// A point of a body: its place, which knows to what it belongs.
    Point(Rc<Point>),
    /// A joint: its rows, which know their names.
    Joint(Rc<Joint>),
    /// Something already reported: fits everywhere.
    Error,
}

/// Numbers in an array, the last index running fastest.
pub(super) struct Array {
    /// How many values each index takes: of a vector its length, of a matrix its rows and columns.
    shape: Vec<usize>,
    entries: Vec<Id>,
}

impl Value {
    pub(super) fn new(shape: &[usize], entries: Vec<Id>) -> Self {
        match (shape, &entries[..]) {
            ([], [id]) => Value::Scalar(*id),
            _ => Value::Array(Rc::new(Array {
                shape: shape.to_vec(),
                entries,
            })),
        }
    }

    pub(super) fn vector(entries: Vec<Id>) -> Self {
        Value::new(&[entries.len()], entries)
    }

    /// The shape of the value, empty for a number.
    pub(super) fn shape(&self) -> &[usize] {
        match self {
            Value::Array(array) => &array.shape,
            Value::Point(point) => point.place.shape(),
            Value::Joint(joint) => joint.rows.shape(),
            Value::Scalar(_) | Value::Body(_) | Value::Error => &[],
        }
    }

    /// The numbers that it consists of.
    pub(super) fn entries(&self) -> &[Id] {
        match self {
            Value::Scalar(id) => std::slice::from_ref(id),
            Value::Array(array) => &array.entries,
            Value::Point(point) => point.place.entries(),
            Value::Joint(joint) => joint.rows.entries(),
            Value::Body(_) | Value::Error => &[],
        }
    }

    pub(super) fn is_error(&self) -> bool {
        matches!(self, Value::Error)
    }

    /// The value with each number replaced.
    pub(super) fn map(&self, new: impl FnMut(Id) -> Id) -> Self {
        match self {
            Value::Error => Value::Error,
            _ => {
                let entries = self.entries().iter().copied();
                Value::new(self.shape(), entries.map(new).collect())
            }
        }
    }

    /// What `indices`, not more than it has, choose of it; the position of the one that is out of range, if one is.
    pub(super) fn block(&self, indices: &[i64]) -> Result<Self, usize> {
        let range = block(self.shape(), indices)?;
        let shape = &self.shape()[indices.len()..];
        Ok(Value::new(shape, self.entries()[range].to_vec()))
    }

    /// How many numbers `parts` have in all.
    pub(super) fn count<'a>(parts: impl IntoIterator<Item = &'a Value>) -> usize {
        parts.into_iter().map(|part| part.entries().len()).sum()
    }

    /// How many terms its product with `other` has, if their shapes allow one.
    pub(super) fn terms(&self, other: &Value) -> Option<usize> {
        match (self.shape(), other.shape()) {
            ([_, inner], [height] | [height, _]) if inner == height => {
                Some(self.entries().len() * (other.entries().len() / height))
            }
            _ => None,
        }
    }

    /// Parts of one shape as one array; else the position of the first that differs from those before. What is in error counts as zero, so
    /// that names that depend on the shape stay what they were meant to be.
    pub(super) fn stack(parts: &[Value], zero: Id) -> Result<Self, usize> {
        let sound = parts.iter().find(|part| !part.is_error());
        let shape = sound.map_or(&[][..], Value::shape);
        let differs = |part: &Value| {
            matches!(part, Value::Body(_)) || !part.is_error() && part.shape() != shape
        };
        if let Some(odd) = parts.iter().position(differs) {
            return Err(odd);
        }
        let mut entries = Vec::new();
        for part in parts {
            match part {
                Value::Error => entries.extend(vec![zero; shape.iter().product()]),
                _ => entries.extend_from_slice(part.entries()),
            }
        }
        let mut stacked = vec![parts.len()];
        stacked.extend_from_slice(shape);
        Ok(Value::new(&stacked, entries))
    }

    /// The transpose of the value; nothing of what is no matrix.
    pub(super) fn transposed(&self) -> Option<Value> {
        let [rows, columns] = *self.shape() else {
            return None;
        };
        let places = (0..columns).flat_map(|j| (0..rows).map(move |i| i * columns + j));
        let entries = places.map(|place| self.entries()[place]).collect();
        Some(Value::new(&[columns, rows], entries))
    }

    /// The product of a matrix with a matrix or a vector, where [`Value::terms`] has an answer.
    pub(super) fn times(&self, other: &Value, g: &mut Graph) -> Value {
        let [rows, inner] = self.shape() else {
            return Value::Error;
        };
        let mut shape = other.shape().to_vec();
        shape[0] = *rows;
        let columns = other.entries().len() / inner;
        let mut entries = Vec::with_capacity(rows * columns);
        for row in self.entries().chunks(*inner) {
            for column in 0..columns {
                let column = other.entries().iter().skip(column).step_by(columns);
                entries.push(sum_of_products(row.iter().zip(column), g));
            }
        }
        Value::new(&shape, entries)
    }
}

/// Σ aᵢ bᵢ.
pub(super) fn sum_of_products<'a>(
    pairs: impl Iterator<Item = (&'a Id, &'a Id)>,
    g: &mut Graph,
) -> Id {
    let terms: Vec<(f64, Id)> = pairs.map(|(a, b)| (1.0, g.mul(*a, *b))).collect();
    g.sum(&terms)
}

/// What has this shape, in words.
pub(super) fn describe(shape: &[usize]) -> String {
    match shape {
        [] => "a number".to_owned(),
        [n] => format!("a vector of {n}"),
        [rows, columns] => format!("a matrix of {rows}×{columns}"),
        _ => {
            let sizes: Vec<String> = shape.iter().map(usize::to_string).collect();
            format!("an array of {}", sizes.join("×"))
        }
    }
}
