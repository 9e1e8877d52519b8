//! How is a binary glTF file written?
//!
//! One mesh of triangles in one scene: a chunk of JSON, then a chunk of indices, positions and normals, as glTF 2.0 lays them
//! out.

use super::super::output::{Coordinates, Output, refused};
use super::fan;
use serde_json::{Value, json};
use std::io::{self, Write};

/// The types of numbers and the targets of buffers, as glTF numbers them.
const U32: u32 = 5125;
const F32: u32 = 5126;
const INDICES: u32 = 34963;
const VERTICES: u32 = 34962;

pub(super) fn write(output: &Output, to: &mut impl Write) -> io::Result<Vec<String>> {
    let indices = 4 * 3 * fan::count(output.faces) as u64;
    let vertices = 4 * 3 * output.positions.len() as u64;
    let binary = indices + vertices * if output.normals.is_some() { 2 } else { 1 };
    let mut json = document(output, indices, vertices).to_string().into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let whole = 12 + 8 + json.len() as u64 + 8 + binary;
    let whole = u32::try_from(whole).map_err(|_| too_large(whole))?;
    for part in [b"glTF".as_slice(), &2_u32.to_le_bytes(), &whole.to_le_bytes()] {
        to.write_all(part)?;
    }
    chunk(json.len() as u32, *b"JSON", to)?;
    to.write_all(&json)?;
    chunk(binary as u32, *b"BIN\0", to)?;
    let mut corners = fan::triangles(output.faces).flatten();
    corners.try_for_each(|corner| to.write_all(&corner.to_le_bytes()))?;
    for list in [Some(output.positions), output.normals].into_iter().flatten() {
        list.singles().flatten().try_for_each(|value| to.write_all(&value.to_le_bytes()))?;
    }
    Ok(fan::note(output.faces).into_iter().collect())
}

fn chunk(length: u32, kind: [u8; 4], to: &mut impl Write) -> io::Result<()> {
    to.write_all(&length.to_le_bytes())?;
    to.write_all(&kind)
}

/// The JSON of a file whose indices take so many bytes, and its positions and its normals so many each.
fn document(output: &Output, indices: u64, vertices: u64) -> Value {
    let view = |start: u64, length: u64, target: u32| json!({ "buffer": 0, "byteOffset": start, "byteLength": length, "target": target });
    let (count, [low, high]) = (output.positions.len(), bounds(output.positions));
    let mut views = vec![view(0, indices, INDICES), view(indices, vertices, VERTICES)];
    let mut accessors = vec![
        json!({ "bufferView": 0, "componentType": U32, "type": "SCALAR", "count": indices / 4 }),
        json!({ "bufferView": 1, "componentType": F32, "type": "VEC3", "count": count, "min": low, "max": high }),
    ];
    let mut attributes = json!({ "POSITION": 1 });
    if output.normals.is_some() {
        views.push(view(indices + vertices, vertices, VERTICES));
        accessors.push(json!({ "bufferView": 2, "componentType": F32, "type": "VEC3", "count": count }));
        attributes["NORMAL"] = json!(2);
    }
    let length = indices + vertices * (views.len() as u64 - 1);
    json!({
        "asset": { "version": "2.0", "generator": "eigenring" },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{ "attributes": attributes, "indices": 0, "mode": 4 }] }],
        "buffers": [{ "byteLength": length }],
        "bufferViews": views,
        "accessors": accessors,
    })
}

/// The least and the greatest of each coordinate.
fn bounds(positions: Coordinates) -> [[f32; 3]; 2] {
    let mut bounds = [[f32::INFINITY; 3], [f32::NEG_INFINITY; 3]];
    for point in positions.singles() {
        for (axis, value) in point.into_iter().enumerate() {
            bounds[0][axis] = bounds[0][axis].min(value);
            bounds[1][axis] = bounds[1][axis].max(value);
        }
    }
    bounds
}

fn too_large(bytes: u64) -> io::Error {
    refused(format!(
        "a glTF file can't have more than 2^32 - 1 bytes, but this mesh needs {bytes}: write PLY, or parts"
    ))
}
