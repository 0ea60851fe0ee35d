//! The table of a sweep as Parquet, with the types of its columns, for readers of large tables.
//!
//! A table grows row by row, and goes on where it was broken off; a Parquet file is written at once, its directory last. So the rows are
//! collected as CSV, and written as Parquet when all are there.

use std::fmt::Display;
use std::fs::File;
use std::io::Write;
use std::path::Path;
use std::str::FromStr;
use std::sync::Arc;

use csv::StringRecord;
use parquet::basic::{LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedColumnWriter, SerializedFileWriter};
use parquet::schema::types::{Type, TypePtr};

use crate::failure::Failure;
use crate::output::write_whole;

/// So many rows are held as numbers at a time.
const GROUP: usize = 1 << 16;

/// Columns of text, and of whole numbers; all others are numbers. (No parameter or quantity is called like one of these.)
const TEXT: [&str; 4] = ["start", "method", "stabilisation", "error"];
const WHOLE: [&str; 5] = ["member", "steps", "rejected", "evaluations", "fallbacks"];

/// Writes the `table`, as `sweep` leaves it, to `out`. What a row does not have is null.
pub(crate) fn write(table: &Path, out: &Path) -> Result<(), Failure> {
    let broken = |e: &dyn Display| Failure::Failed(format!("cannot read {}: {e}", table.display()));
    let file = File::open(table).map_err(|e| broken(&e))?;
    let mut reader = csv::Reader::from_reader(file);
    let names = reader.headers().map_err(|e| broken(&e))?.clone();
    let failed = |e: ParquetError| Failure::Failed(format!("cannot write {}: {e}", out.display()));
    let columns: Result<Vec<TypePtr>, _> = names.iter().map(column).collect();
    let schema = columns.and_then(|columns| {
        Type::group_type_builder("sweep")
            .with_fields(columns)
            .build()
    });
    let schema = Arc::new(schema.map_err(failed)?);
    let properties = Arc::new(WriterProperties::default());
    let mut bytes = Vec::new();
    let mut file = SerializedFileWriter::new(&mut bytes, schema, properties).map_err(failed)?;
    let mut records = reader.records();
    loop {
        let rows: Result<Vec<_>, _> = records.by_ref().take(GROUP).collect();
        let rows: Vec<StringRecord> = rows.map_err(|e| broken(&e))?;
        if rows.is_empty() {
            break;
        }
        group(&mut file, &names, &rows).map_err(failed)?;
    }
    file.close().map_err(failed)?;
    write_whole(out, |out| out.write_all(&bytes))
}

/// The column called `name`.
fn column(name: &str) -> Result<TypePtr, ParquetError> {
    let (physical, logical) = match name {
        _ if TEXT.contains(&name) => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
        _ if WHOLE.contains(&name) => (Physical::INT64, None),
        _ => (Physical::DOUBLE, None),
    };
    let column = Type::primitive_type_builder(name, physical);
    let column = column.with_repetition(Repetition::OPTIONAL);
    column.with_logical_type(logical).build().map(Arc::new)
}

/// Writes these rows, column by column.
fn group<W: Write + Send>(
    file: &mut SerializedFileWriter<W>,
    names: &StringRecord,
    rows: &[StringRecord],
) -> Result<(), ParquetError> {
    let mut group = file.next_row_group()?;
    for (k, name) in names.iter().enumerate() {
        let cells = || rows.iter().map(|row| row.get(k).unwrap_or_default());
        let known: Vec<i16> = cells().map(|cell| i16::from(!cell.is_empty())).collect();
        let there = cells().filter(|cell| !cell.is_empty());
        let Some(column) = group.next_column()? else {
            break;
        };
        if TEXT.contains(&name) {
            let texts: Vec<_> = there.map(ByteArray::from).collect();
            fill::<ByteArrayType>(column, &known, &texts)?;
        } else if WHOLE.contains(&name) {
            fill::<Int64Type>(column, &known, &numbers(name, there)?)?;
        } else {
            fill::<DoubleType>(column, &known, &numbers(name, there)?)?;
        }
    }
    group.close().map(|_| ())
}

/// Writes what a column has, where it is `known`.
fn fill<T: DataType>(
    mut column: SerializedColumnWriter<'_>,
    known: &[i16],
    values: &[T::T],
) -> Result<(), ParquetError> {
    let typed = column.typed::<T>();
    typed.write_batch(values, Some(known), None)?;
    column.close()
}

fn numbers<'a, T: FromStr>(
    name: &str,
    cells: impl Iterator<Item = &'a str>,
) -> Result<Vec<T>, ParquetError> {
    let read = |cell: &str| {
        let wrong = || ParquetError::General(format!("`{cell}` in column `{name}` is no number"));
        cell.parse().map_err(|_| wrong())
    };
    cells.map(read).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::record::Field;

    #[test]
    fn what_is_written_is_read_back() {
        let place = tempfile::tempdir().expect("a directory");
        let (table, out) = (place.path().join("a.csv"), place.path().join("a.parquet"));
        let third = 1.0_f64 / 3.0;
        let csv = format!(
            "member,start,k,max(x),steps,error\n0,released,{third:?},1e-300,12,\n1,released,2.0,,0,\"a, b\"\n"
        );
        std::fs::write(&table, csv).expect("a table");
        write(&table, &out).expect("written");
        let file = File::open(&out).expect("it is there");
        let reader = SerializedFileReader::new(file).expect("Parquet");
        let rows: Vec<_> = reader.get_row_iter(None).expect("rows").collect();
        let rows = rows.into_iter().map(|row| row.expect("a row"));
        let rows: Vec<Vec<(String, Field)>> = rows.map(|row| row.into_columns()).collect();
        let text = |text: &str| Field::Str(text.to_owned());
        let expected = [
            [
                Field::Long(0),
                text("released"),
                Field::Double(third),
                Field::Double(1e-300),
                Field::Long(12),
                Field::Null,
            ],
            [
                Field::Long(1),
                text("released"),
                Field::Double(2.0),
                Field::Null,
                Field::Long(0),
                text("a, b"),
            ],
        ];
        assert_eq!(rows.len(), 2);
        for (row, expected) in rows.iter().zip(&expected) {
            let names: Vec<&str> = row.iter().map(|(name, _)| name.as_str()).collect();
            assert_eq!(names, ["member", "start", "k", "max(x)", "steps", "error"]);
            let found: Vec<&Field> = row.iter().map(|(_, field)| field).collect();
            assert_eq!(found, expected.iter().collect::<Vec<_>>());
        }
        std::fs::write(&table, "member,k\n0,much\n").expect("a table");
        let error = write(&table, &out).expect_err("no number").message();
        assert!(
            error.contains("`much` in column `k` is no number"),
            "{error}"
        );
    }
}
