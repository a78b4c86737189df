// Paths of keys, such as objects.oak.tree.height.
#ifndef RAMIFY_BASE_KEY_PATH_H
#define RAMIFY_BASE_KEY_PATH_H

// The last name of a path and the numbers after it: "height", "position.0". Part of `path`.
const char *key_path_end(const char *path);

#endif
