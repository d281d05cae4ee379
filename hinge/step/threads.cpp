#include "hinge/step/threads.hpp"

#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace diptych {

struct Threads::Pool {
  tbb::task_arena arena;
};

Threads::Threads(int most) {
  const int count = std::min(most, tbb::this_task_arena::max_concurrency());
  if (count > 1) pool_ = std::make_unique<Pool>(Pool{tbb::task_arena(count)});
}

Threads::~Threads() = default;

// Pieces are dealt out alike every time, so that a thread finds its own again in its cache.
void Threads::run(std::size_t count, Call call, void* of) const {
  pool_->arena.execute([&] {
    tbb::parallel_for(
        std::size_t{0}, count, [&](std::size_t k) { call(of, k); }, tbb::static_partitioner{});
  });
}

}  // namespace diptych
