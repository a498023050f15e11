//! Supports at nodes: held directions are taken out of nodal values and of blocks of the tangent.

use super::numbers::PrescribedNumbers;
use percuss::internals::scalar::{Number, array};
use percuss::math::vec2::dot4;

impl<S: Number> PrescribedNumbers<S> {
    /// Takes held components out of a node's values.
    #[inline(always)]
    pub fn project(&self, x: &mut [S; 4]) {
        match self.components {
            Some(held) => {
                for k in 0..4 {
                    if held[k] {
                        x[k] = x[k].constant(0.0);
                    }
                }
            }
            None => {
                for normal in &self.normals {
                    remove(normal, x);
                }
            }
        }
    }

    /// Takes held rows out of a block.
    #[inline(always)]
    pub fn project_rows(&self, block: &mut [[S; 4]; 4]) {
        match self.components {
            Some(held) => {
                for k in 0..4 {
                    if held[k] {
                        block[k] = [block[k][0].constant(0.0); 4];
                    }
                }
            }
            None => {
                for j in 0..4 {
                    let mut column = array(|i| block[i][j]);
                    for normal in &self.normals {
                        remove(normal, &mut column);
                    }
                    for i in 0..4 {
                        block[i][j] = column[i];
                    }
                }
            }
        }
    }

    /// Takes held columns out of a block.
    #[inline(always)]
    pub fn project_columns(&self, block: &mut [[S; 4]; 4]) {
        match self.components {
            Some(held) => {
                for row in block {
                    for k in 0..4 {
                        if held[k] {
                            row[k] = row[k].constant(0.0);
                        }
                    }
                }
            }
            None => {
                for row in block {
                    for normal in &self.normals {
                        remove(normal, row);
                    }
                }
            }
        }
    }
}

/// Takes a direction out of a vector.
#[inline(always)]
fn remove<S: Number>(normal: &[S; 4], x: &mut [S; 4]) {
    let along = dot4(normal, x);
    for k in 0..4 {
        x[k] = x[k].sub_product(along, normal[k]);
    }
}
