// Weighted linear regression of what a pixel shows on features of its neighbours (Moon 2014;
// Bitterli 2016), for a row of pixels at a time. Features are differences from the pixel's own, so
// the fit at the pixel itself is a weighted mean of its neighbours, whose weights are all that is
// needed of it.
#ifndef RAMIFY_IMAGE_REGRESSION_H
#define RAMIFY_IMAGE_REGRESSION_H

enum {
    LANES = 64, // pixels of a row
    FEATURES = 8
};

typedef float Lane[LANES];

typedef struct Regression {
    Lane weight, square;              // sums over neighbours: of weights, of their squares
    Lane mean[FEATURES];              // of weighted features; after the solution their means
    Lane product[FEATURES][FEATURES]; // of weighted products, k <= l in [l][k]
    Lane slope[FEATURES], base;       // the solution
} Regression;

void regression_clear(Regression *r);

// Adds a neighbour of each pixel.
void regression_add(Regression *r, const Lane weight, const Lane feature[FEATURES]);

// ridge: how much slopes are held down (Hoerl 1970), in feature squares over effective neighbours.
void regression_solve(Regression *r, float ridge);

// The neighbour's share in the fit at the pixel; all of a pixel's neighbours have a sum of about 1.
// None is negative: fits must not overshoot.
void regression_share(const Regression *r, const Lane weight, const Lane feature[FEATURES],
                      Lane share);

#endif
