#include "base/fft.h"

#include "base/exact_math.h"
#include "base/memory.h"

Complex *fft_roots(int64_t count, Error *e)
{
    Complex *root = memory_alloc(count / 2, sizeof *root, e);
    for (int64_t k = 0; root && k < count / 2; k++) {
        double sine, cosine;
        exact_sincos_double(6.28318530717958647692 * (double)k / (double)count, &sine, &cosine);
        root[k] = (Complex){cosine, -sine};
    }
    return root;
}

static void reverse_bits(Complex *x, int64_t count)
{
    for (int64_t i = 1, j = 0; i < count; i++) {
        int64_t bit = count >> 1;
        for (; j & bit; bit >>= 1) {
            j ^= bit;
        }
        j ^= bit;
        if (i < j) {
            Complex swap = x[i];
            x[i] = x[j];
            x[j] = swap;
        }
    }
}

// Cooley and Tukey 1965, radix 2, decimation in time.
void fft_transform(Complex *x, int64_t count, const Complex *root)
{
    reverse_bits(x, count);
    for (int64_t half = 1; half < count; half *= 2) {
        int64_t stride = count / (2 * half);
        for (int64_t start = 0; start < count; start += 2 * half) {
            for (int64_t k = 0; k < half; k++) {
                Complex w = root[k * stride], a = x[start + k], b = x[start + k + half];
                Complex t = complex_times(w, b);
                x[start + k] = (Complex){a.re + t.re, a.im + t.im};
                x[start + k + half] = (Complex){a.re - t.re, a.im - t.im};
            }
        }
    }
}
