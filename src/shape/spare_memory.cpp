#include "shape/spare_memory.h"

#include <atomic>
#include <cstddef>
#include <mutex>
#include <new>

namespace
{

// A destructor lists a tree's leaves, in a list that doubles: up to 24 bytes a leaf of 2 kB. This
// is enough for 5 GB of voxels; it takes room, but no memory, since nothing writes it. Above 32 MB
// free() does not change how malloc() treats other large blocks.
constexpr size_t SPARE_BYTES = size_t(64) << 20;

// The handler of operator new is one of the whole process and is told nothing, so what it gives
// back can only be the process's.
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
        s.before = std::set_new_handler(give_back);
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
