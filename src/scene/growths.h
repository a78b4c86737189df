// Whole growths of the objects of a scene that contend. A contest is grown once, when the first of
// its objects is asked for, and is kept as long as the scene.
#ifndef RAMIFY_SCENE_GROWTHS_H
#define RAMIFY_SCENE_GROWTHS_H

#include "objects/common/recipe.h"

typedef struct Growths Growths;

Growths *growths_new(int objects, Error *e);
void growths_free(Growths *growths); // NULL is fine

// Entries by object, {0} until grown. The calling thread alone may fill them until growths_close;
// it may open them again. A filled entry stays as it is, so it may be read after that.
Grown *growths_open(Growths *growths);
void growths_close(Growths *growths);

#endif
