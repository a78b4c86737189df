#include "image/color_matrix.h"

const double COLOR_REC709[3][2] = {{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}};
const double COLOR_D65[2] = {0.3127, 0.3290};

void color_matrix_multiply(ColorMatrix a, ColorMatrix b, ColorMatrix out)
{
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            out[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
        }
    }
}

void color_matrix_invert(ColorMatrix m, ColorMatrix out)
{
    double determinant = 0.0;
    for (int i = 0; i < 3; i++) {
        determinant += m[0][i] * (m[1][(i + 1) % 3] * m[2][(i + 2) % 3] -
                                  m[1][(i + 2) % 3] * m[2][(i + 1) % 3]);
    }
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            int a = (j + 1) % 3, b = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
            out[i][j] = (m[a][c] * m[b][d] - m[a][d] * m[b][c]) / determinant;
        }
    }
}

static void xyz_of(const double xy[2], double xyz[3])
{
    xyz[0] = xy[0] / xy[1];
    xyz[1] = 1.0;
    xyz[2] = (1.0 - xy[0] - xy[1]) / xy[1];
}

void color_matrix_to_xyz(const double primary[3][2], const double white[2], ColorMatrix out)
{
    ColorMatrix unscaled, inverse;
    double wanted[3];
    xyz_of(white, wanted);
    for (int j = 0; j < 3; j++) {
        double xyz[3];
        xyz_of(primary[j], xyz);
        for (int i = 0; i < 3; i++) {
            unscaled[i][j] = xyz[i];
        }
    }
    color_matrix_invert(unscaled, inverse);
    for (int j = 0; j < 3; j++) {
        double scale =
            inverse[j][0] * wanted[0] + inverse[j][1] * wanted[1] + inverse[j][2] * wanted[2];
        for (int i = 0; i < 3; i++) {
            out[i][j] = unscaled[i][j] * scale;
        }
    }
}
