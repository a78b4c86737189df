// What the command says when an outside library ends it.
#ifndef RAMIFY_CLI_LAST_WORDS_H
#define RAMIFY_CLI_LAST_WORDS_H

#ifdef __cplusplus
extern "C" {
#endif

// From now on, an exception that no caller can catch (out of memory in a function of a library that
// is declared to throw nothing, no thread to be had in TBB's scheduler) is one line on stderr and
// exit status 1 instead of abort(). Files that are not complete have no name yet, so nothing is
// left behind.
void last_words_begin(void);

#ifdef __cplusplus
}
#endif

#endif
