#include "shape/spare_memory.h"

#include <atomic>
#include <cstddef>
#include <mutex>
#include <new>

namespace
{

// A tree's destructor collects its leaves in a growing list, up to 24 bytes per leaf of 2 kB, so
// this suffices for 5 GB of voxels. It takes address space but no memory, since it is never
// written. Above 32 MB free() does not change how malloc() treats other large blocks.
constexpr size_t SPARE_BYTES = size_t(64) << 20;

// The handler of operator new is global and has no argument, so the memory it releases is global
// too.
struct Shared {
    std::mutex lock; // for all but the handler
    int users = 0;
    std::new_handler before = nullptr;
    std::atomic<void *> spare{nullptr};
};

Shared &shared()
{
    static Shared made;
    return made;
}

void give_back()
{
    ::operator delete(shared().spare.exchange(nullptr));
    throw std::bad_alloc();
}

} // namespace

SpareMemory::SpareMemory()
{
    Shared &s = shared();
    std::lock_guard<std::mutex> held(s.lock);
    if (!s.spare.load()) {
        s.spare = ::operator new(SPARE_BYTES);
    }
    if (s.users++ == 0) {
        s.before = std::get_new_handler();
        std::set_new_handler(s.before ? s.before : give_back);
    }
}

SpareMemory::~SpareMemory()
{
    Shared &s = shared();
    std::lock_guard<std::mutex> held(s.lock);
    if (--s.users == 0) {
        std::set_new_handler(s.before);
        ::operator delete(s.spare.exchange(nullptr));
    }
}
