// Affine maps in double, as 3x4 rows: what the primitives need beyond Transform.
#ifndef RAMIFY_SHAPE_AFFINE_H
#define RAMIFY_SHAPE_AFFINE_H

#include <stdbool.h>

// m * (p, 1).
void affine_point(const double m[3][4], const double p[3], double out[3]);

double affine_determinant(const double m[3][4]);

// Cofactors of the linear part: map area vectors (and, but for length, normals) of surfaces.
void affine_cofactors(const double m[3][4], double cofactor[3][3]);

// False when m is singular or not finite.
bool affine_inverse(const double m[3][4], double inverse[3][4]);

// The image of the unit sphere: columns of axes are unit and orthogonal, length[j] the half-axis
// along column j (Jacobi's eigenvalue method on m m^T).
void affine_principal_axes(const double m[3][4], double axes[3][3], double length[3]);

// The motion whose linear part is the orthogonal matrix axes and whose translation is that of m,
// and its inverse.
void affine_rigid(const double axes[3][3], const double m[3][4], double forward[3][4],
                  double inverse[3][4]);

#endif
