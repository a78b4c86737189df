// Memory kept back while OpenVDB works. Its trees allocate in their destructors, and a destructor
// that cannot ends the program. C++.
#ifndef RAMIFY_SHAPE_SPARE_MEMORY_H
#define RAMIFY_SHAPE_SPARE_MEMORY_H

// As long as one of these lives, operator new that finds no memory gives the spare memory back
// before it throws std::bad_alloc, so that the destructors on the way to the handler find some. The
// constructor throws std::bad_alloc where not even that much is left. Several threads may each have
// their own; they share the memory.
class SpareMemory
{
  public:
    SpareMemory();
    ~SpareMemory();
    SpareMemory(const SpareMemory &) = delete;
    SpareMemory &operator=(const SpareMemory &) = delete;
};

#endif
