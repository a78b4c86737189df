// Affine maps in double precision, stored as 3x4 rows.
#ifndef RAMIFY_SHAPE_AFFINE_H
#define RAMIFY_SHAPE_AFFINE_H

#include <stdbool.h>

// Computes m * (p, 1).
void affine_point(const double m[3][4], const double p[3], double out[3]);

double affine_determinant(const double m[3][4]);

// Computes the cofactors of the linear part, which map area vectors (and, up to length, normals).
void affine_cofactors(const double m[3][4], double cofactor[3][3]);

// Inverts m; false when m is singular or not finite.
bool affine_inverse(const double m[3][4], double inverse[3][4]);

// Computes the ellipsoid that is the image of the unit sphere: the columns of axes are orthonormal,
// length[j] is the half-axis along column j (Jacobi's eigenvalue method on m m^T).
void affine_principal_axes(const double m[3][4], double axes[3][3], double length[3]);

// Computes the rigid motion with linear part axes (orthogonal) and the translation of m, and its
// inverse.
void affine_rigid(const double axes[3][3], const double m[3][4], double forward[3][4],
                  double inverse[3][4]);

#endif
