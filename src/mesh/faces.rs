//! Which vertices are the corners of which face?
//!
//! One list of corners, face by face, counter-clockwise. Where all faces have the same number of corners nothing else is
//! stored: face and place of a corner are arithmetic.

/// The faces of a mesh as lists of vertices.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Faces {
    corners: Vec<u32>,
    sides: Sides,
}

/// How the corners are dealt out to the faces.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Sides {
    /// The same number of corners for each face.
    Same(u32),
    /// Where each face starts, and the end of the last; and the face of each corner.
    Mixed {
        /// One entry more than there are faces.
        starts: Vec<u32>,
        /// One entry for each corner.
        face: Vec<u32>,
    },
}

impl Faces {
    /// Faces of one size; a rest of corners that don't fill a face is cut off.
    pub fn same(size: u32, mut corners: Vec<u32>) -> Faces {
        let size = size.max(1);
        corners.truncate(corners.len() / size as usize * size as usize);
        Faces { corners, sides: Sides::Same(size) }
    }

    /// Faces of these sizes, whose corners follow each other. Sizes that are all the same are not stored.
    ///
    /// The sizes must add up to the number of corners; corners beyond them are cut off.
    pub fn mixed(sizes: &[u32], mut corners: Vec<u32>) -> Faces {
        if let Some(first) = sizes.first()
            && sizes.iter().all(|size| size == first)
            && *first > 0
        {
            corners.truncate(sizes.len() * *first as usize);
            return Faces::same(*first, corners);
        }
        let mut starts = Vec::with_capacity(sizes.len() + 1);
        let mut face = Vec::with_capacity(corners.len());
        let mut end = 0;
        for (index, size) in sizes.iter().enumerate() {
            starts.push(end);
            end += size;
            face.resize(end as usize, index as u32);
        }
        starts.push(end);
        corners.truncate(end as usize);
        Faces { corners, sides: Sides::Mixed { starts, face } }
    }

    /// Faces as a list of lists.
    pub fn from_lists<T: AsRef<[usize]>>(faces: &[T]) -> Faces {
        let sizes: Vec<u32> = faces.iter().map(|face| face.as_ref().len() as u32).collect();
        let corners = faces.iter().flat_map(|face| face.as_ref()).map(|vertex| *vertex as u32).collect();
        Faces::mixed(&sizes, corners)
    }

    /// The number of faces.
    pub fn len(&self) -> usize {
        match &self.sides {
            Sides::Same(size) => self.corners.len() / *size as usize,
            Sides::Mixed { starts, .. } => starts.len() - 1,
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// All corners, face by face: the index buffer.
    pub fn corners(&self) -> &[u32] {
        &self.corners
    }

    /// All corners, to be given back as a buffer.
    pub fn into_corners(self) -> Vec<u32> {
        self.corners
    }

    /// The size of every face, where it is the same for all.
    pub fn same_size(&self) -> Option<u32> {
        if let Sides::Same(size) = self.sides { Some(size) } else { None }
    }

    /// How the corners are dealt out.
    pub fn sides(&self) -> &Sides {
        &self.sides
    }

    /// The corners of a face, as a range of all corners.
    pub fn range(&self, face: usize) -> std::ops::Range<usize> {
        match &self.sides {
            Sides::Same(size) => face * *size as usize..(face + 1) * *size as usize,
            Sides::Mixed { starts, .. } => starts[face] as usize..starts[face + 1] as usize,
        }
    }

    /// The vertices of a face.
    pub fn face(&self, face: usize) -> &[u32] {
        &self.corners[self.range(face)]
    }

    /// The faces in order.
    pub fn iter(&self) -> impl Iterator<Item = &[u32]> {
        (0..self.len()).map(|face| self.face(face))
    }

    /// The face that a corner belongs to.
    #[inline]
    pub fn face_of(&self, corner: u32) -> u32 {
        match &self.sides {
            Sides::Same(3) => corner / 3,
            Sides::Same(size) => corner / size,
            Sides::Mixed { face, .. } => face[corner as usize],
        }
    }

    /// The next corner of the same face, counter-clockwise.
    #[inline]
    pub fn next(&self, corner: u32) -> u32 {
        match &self.sides {
            Sides::Same(4) => corner & !3 | (corner + 1) & 3,
            Sides::Same(size) => {
                if corner % size == size - 1 {
                    corner + 1 - size
                } else {
                    corner + 1
                }
            }
            Sides::Mixed { starts, face } => {
                let face = face[corner as usize] as usize;
                if corner + 1 == starts[face + 1] { starts[face] } else { corner + 1 }
            }
        }
    }

    /// The previous corner of the same face.
    #[inline]
    pub fn prev(&self, corner: u32) -> u32 {
        match &self.sides {
            Sides::Same(4) => corner & !3 | (corner + 3) & 3,
            Sides::Same(size) => {
                if corner.is_multiple_of(*size) {
                    corner + size - 1
                } else {
                    corner - 1
                }
            }
            Sides::Mixed { starts, face } => {
                let face = face[corner as usize] as usize;
                if corner == starts[face] { starts[face + 1] - 1 } else { corner - 1 }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faces_of_one_size_walk_as_mixed_ones_do() {
        let lists: Vec<Vec<usize>> = vec![vec![0, 1, 2, 3], vec![3, 2, 4], vec![4, 5, 6, 7, 0]];
        let mixed = Faces::from_lists(&lists);
        assert!(mixed.same_size().is_none() && mixed.len() == 3);
        for (face, list) in lists.iter().enumerate() {
            assert!(mixed.face(face).iter().map(|v| *v as usize).eq(list.iter().copied()));
            for corner in mixed.range(face) {
                assert_eq!(mixed.face_of(corner as u32) as usize, face);
                assert_eq!(mixed.prev(mixed.next(corner as u32)) as usize, corner);
            }
        }
        for size in [3, 4, 5] {
            let corners: Vec<u32> = (0..size * 4).collect();
            let same = Faces::mixed(&[size; 4], corners.clone());
            assert_eq!(same.same_size(), Some(size));
            let starts = (0..5).map(|face| face * size).collect();
            let face = corners.iter().map(|corner| corner / size).collect();
            let stored = Faces { corners, sides: Sides::Mixed { starts, face } };
            for corner in 0..size * 4 {
                assert_eq!(same.next(corner), stored.next(corner));
                assert_eq!(same.prev(corner), stored.prev(corner));
                assert_eq!(same.face_of(corner), stored.face_of(corner));
            }
        }
    }
}
