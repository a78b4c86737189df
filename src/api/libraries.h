// The versions of the libraries that this one was compiled with.
#ifndef RAMIFY_API_LIBRARIES_H
#define RAMIFY_API_LIBRARIES_H

#ifdef __cplusplus
extern "C" {
#endif

// "Embree 3.13.5, ...": those whose headers state a version; static text.
const char *libraries_compiled(void);

#ifdef __cplusplus
}
#endif

#endif
