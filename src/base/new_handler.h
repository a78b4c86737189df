// What happens when operator new of C++ finds no memory, for C.
#ifndef RAMIFY_BASE_NEW_HANDLER_H
#define RAMIFY_BASE_NEW_HANDLER_H

#ifdef __cplusplus
extern "C" {
#endif

// Calls handler instead of throwing std::bad_alloc, in all threads and libraries of this process.
// The handler must not return.
void new_handler_set(void (*handler)(void));

#ifdef __cplusplus
}
#endif

#endif
