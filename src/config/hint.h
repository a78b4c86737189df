// Hints for unknown words: "did you mean" the nearest known word.
#ifndef RAMIFY_CONFIG_HINT_H
#define RAMIFY_CONFIG_HINT_H

// Number of single-letter edits (insert, delete, replace, swap neighbours) between two words of
// fewer than 64 letters; a large number for longer ones.
int hint_distance(const char *a, const char *b);

// Index of the word nearest to `word`; -1 when none is similar enough.
int hint_nearest(const char *word, const char *const *known, int count);

// Writes "a, b, c" into text; lists of more than 24 words are truncated.
void hint_list(const char *const *known, int count, char *text, int size);

// Writes "did you mean 'x'?" when a known word is near, "known: a, b, c" otherwise, or "nothing is
// known here" when count is 0, into text.
void hint_format(const char *word, const char *const *known, int count, char *text, int size);

#endif
