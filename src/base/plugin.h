// Plug-ins: shared objects with the code that needs a large library of others. Loading all those
// libraries takes a third of a second, so a plug-in is loaded when one of its functions is first
// called. The Makefile lists the plug-ins (PLUGINS).
//
// A plug-in exports constant tables of functions and nothing else. It links what it uses of our own
// code statically, which is possible because that code has no state.
#ifndef RAMIFY_BASE_PLUGIN_H
#define RAMIFY_BASE_PLUGIN_H

#include "base/error.h"

#include <stddef.h>

// Returns a table, which stays loaded. The loader finds the plug-in's file through the RUNPATH of
// the program or library that this function is linked into.
//
// plugin: e.g. "oiio" for the file ramify-oiio.so. table: name of the table, a struct that begins
// with a size_t, which holds the struct's size. size: the struct's size as the caller knows it.
//
// ERROR_INPUT with the file's name when it cannot be loaded or comes from another build,
// ERROR_MEMORY. Thread-safe; a call costs about a microsecond once the plug-in is loaded. Not for
// child processes (base/child.h): load before the fork.
const void *plugin_table(const char *plugin, const char *table, size_t size, Error *e);

#endif
