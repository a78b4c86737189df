// C++ alone can set what std::terminate calls.
#include "cli/last_words.h"

#include <atomic>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <unistd.h>

namespace
{

// The memory may be used up: no allocation, no stdio.
void say(const char *text)
{
    if (write(STDERR_FILENO, text, std::strlen(text)) < 0) {
        _exit(EXIT_FAILURE);
    }
}

[[noreturn]] void end()
{
    static std::atomic_flag ending;
    if (ending.test_and_set()) { // another thread is about to end the process
        for (;;) {
            pause();
        }
    }
    try {
        std::rethrow_exception(std::current_exception());
    } catch (const std::bad_alloc &) {
        say("ramify: out of memory in a library that cannot go on without; a smaller scene or "
            "picture, or a "
            "higher limit on memory (ulimit -v, -d) would be right\n");
    } catch (const std::exception &failure) {
        say("ramify: a library that cannot go on has failed: ");
        say(failure.what());
        say("\n");
    } catch (...) {
        say("ramify: a library that cannot go on has failed for an unknown reason\n");
    }
    _exit(EXIT_FAILURE); // destructors of libraries would fail again
}

[[noreturn]] void last_words()
{
    if (!std::current_exception()) {
        std::abort(); // a flaw, to be seen in a debugger
    }
    end();
}

} // namespace

void last_words_begin(void)
{
    std::set_terminate(last_words);
}
