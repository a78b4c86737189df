// The registry of growth rules, one line each: a rule's name, which the key `rule` takes and with
// which rule_NAME.c defines rule_NAME; its GrowRule; what it does, for the documentation.
#ifndef RAMIFY_GROW_RULES_RULES_H
#define RAMIFY_GROW_RULES_RULES_H

#define GROWTH_RULES(X)                                                                    \
    X(mean, GROW_MEAN, "one child per step, along the mean pull")                          \
    X(snap, GROW_SNAP, "reached attractors become nodes")                                  \
    X(sectors, GROW_SECTORS, "at most one child in each angular sector about the heading") \
    X(string, GROW_STRING, "directions by an L-system, only in an outtree")

// GROW_MEAN and so on, in the order of the lines.
#define GROWTH_RULE_VALUE(NAME, VALUE, DOC) VALUE,
typedef enum GrowRule { GROWTH_RULES(GROWTH_RULE_VALUE) } GrowRule;
#undef GROWTH_RULE_VALUE

#endif
