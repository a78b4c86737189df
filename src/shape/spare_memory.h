// Reserve memory while OpenVDB works: its trees allocate in their destructors, and an exception
// there ends the program. C++.
#ifndef RAMIFY_SHAPE_SPARE_MEMORY_H
#define RAMIFY_SHAPE_SPARE_MEMORY_H

// While one of these exists, operator new releases the reserve before it throws std::bad_alloc, so
// that destructors can allocate while the stack unwinds. A handler that is there already stays, as
// in a child process (base/child.h). The constructor throws std::bad_alloc if the reserve itself
// cannot be allocated. Thread-safe; all objects share the reserve.
class SpareMemory
{
  public:
    SpareMemory();
    ~SpareMemory();
    SpareMemory(const SpareMemory &) = delete;
    SpareMemory &operator=(const SpareMemory &) = delete;
};

#endif
