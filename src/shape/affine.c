#include "shape/affine.h"

#include <math.h>

void affine_point(const double m[3][4], const double p[3], double out[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = m[i][0] * p[0] + m[i][1] * p[1] + m[i][2] * p[2] + m[i][3];
    }
}

void affine_cofactors(const double m[3][4], double cofactor[3][3])
{
    for (int i = 0; i < 3; i++) {
        int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
        for (int j = 0; j < 3; j++) {
            int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
            cofactor[i][j] = m[i1][j1] * m[i2][j2] - m[i1][j2] * m[i2][j1];
        }
    }
}

double affine_determinant(const double m[3][4])
{
    double cofactor[3][3];
    affine_cofactors(m, cofactor);
    return m[0][0] * cofactor[0][0] + m[0][1] * cofactor[0][1] + m[0][2] * cofactor[0][2];
}

bool affine_inverse(const double m[3][4], double inverse[3][4])
{
    double cofactor[3][3], determinant = affine_determinant(m), size = 1.0;
    affine_cofactors(m, cofactor);
    for (int j = 0; j < 3; j++) {
        size *= sqrt(m[0][j] * m[0][j] + m[1][j] * m[1][j] + m[2][j] * m[2][j]);
    }
    if (!isfinite(determinant) || !(fabs(determinant) > 1e-9 * size) || !isfinite(m[0][3]) ||
        !isfinite(m[1][3]) || !isfinite(m[2][3])) {
        return false;
    }
    for (int i = 0; i < 3; i++) {
        inverse[i][3] = 0.0;
        for (int j = 0; j < 3; j++) {
            inverse[i][j] = cofactor[j][i] / determinant;
            inverse[i][3] -= inverse[i][j] * m[j][3];
        }
    }
    return true;
}

// One Jacobi rotation: makes s[a][b] zero and accumulates the rotation in the columns of v.
static void rotate(double s[3][3], double v[3][3], int a, int b)
{
    double theta = (s[b][b] - s[a][a]) / (2.0 * s[a][b]);
    double t = (theta < 0.0 ? -1.0 : 1.0) / (fabs(theta) + sqrt(theta * theta + 1.0));
    double c = 1.0 / sqrt(t * t + 1.0), d = t * c;
    for (int k = 0; k < 3; k++) {
        double x = s[k][a], y = s[k][b];
        s[k][a] = c * x - d * y;
        s[k][b] = d * x + c * y;
    }
    for (int k = 0; k < 3; k++) {
        double x = s[a][k], y = s[b][k], p = v[k][a], q = v[k][b];
        s[a][k] = c * x - d * y;
        s[b][k] = d * x + c * y;
        v[k][a] = c * p - d * q;
        v[k][b] = d * p + c * q;
    }
}

void affine_principal_axes(const double m[3][4], double axes[3][3], double length[3])
{
    double s[3][3];
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            s[i][j] = m[i][0] * m[j][0] + m[i][1] * m[j][1] + m[i][2] * m[j][2];
            axes[i][j] = i == j ? 1.0 : 0.0;
        }
    }
    for (int sweep = 0; sweep < 32; sweep++) {
        bool done = true;
        for (int a = 0; a < 2; a++) {
            for (int b = a + 1; b < 3; b++) {
                if (fabs(s[a][b]) > 1e-15 * sqrt(s[a][a] * s[b][b])) {
                    rotate(s, axes, a, b);
                    done = false;
                }
            }
        }
        if (done) {
            break;
        }
    }
    for (int j = 0; j < 3; j++) {
        length[j] = sqrt(fmax(s[j][j], 0.0));
    }
}

void affine_rigid(const double axes[3][3], const double m[3][4], double forward[3][4],
                  double inverse[3][4])
{
    for (int i = 0; i < 3; i++) {
        forward[i][3] = m[i][3];
        inverse[i][3] = 0.0;
        for (int j = 0; j < 3; j++) {
            forward[i][j] = axes[i][j];
            inverse[i][j] = axes[j][i];
            inverse[i][3] -= axes[j][i] * m[j][3];
        }
    }
}
