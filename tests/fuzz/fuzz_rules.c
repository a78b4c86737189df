// L-systems: the axiom on the first line, then the rules; checked and derived.
#include "fuzz.h"
#include "grow/lsystem/lsystem.h"

#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *axiom = fuzz_text(data, size);
    char *rules = strchr(axiom, '\n');
    if (rules) {
        *rules++ = 0;
    }
    LSystemParams params = {.axiom = axiom,
                            .rules = rules ? rules : "",
                            .generations = 4,
                            .most_modules = 2000,
                            .seed = 7};
    Run run = run_default();
    ModuleString string = {0};
    Error e = {0};
    if (lsystem_check(&params, &e) && lsystem_derive(&params, &run, &string, &e)) {
        module_string_clear(&string);
    }
    free(axiom);
    return 0;
}
