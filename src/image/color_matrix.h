// 3 x 3 matrices between linear colour spaces.
#ifndef RAMIFY_IMAGE_COLOR_MATRIX_H
#define RAMIFY_IMAGE_COLOR_MATRIX_H

typedef double ColorMatrix[3][3];

// The chromaticities (CIE 1931 x, y) of red, green and blue of Rec. 709, and of its white, D65.
extern const double COLOR_REC709[3][2];
extern const double COLOR_D65[2];

// out = a b; out must be neither.
void color_matrix_multiply(ColorMatrix a, ColorMatrix b, ColorMatrix out);

// out must not be m, which must not be singular.
void color_matrix_invert(ColorMatrix m, ColorMatrix out);

// To CIE XYZ from the linear colours of these primaries, where (1, 1, 1) is white of Y = 1
// (SMPTE RP 177).
void color_matrix_to_xyz(const double primary[3][2], const double white[2], ColorMatrix out);

// out = m rgb; out must not be rgb.
static inline void color_matrix_apply(const float m[3][3], const float rgb[3], float out[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = m[i][0] * rgb[0] + m[i][1] * rgb[1] + m[i][2] * rgb[2];
    }
}

#endif
