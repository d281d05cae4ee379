// Threads that share out a few large pieces of work; oneTBB stays behind them, in one source.
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>

namespace diptych {

class Threads {
 public:
  /// At most so many at once, and no more than the machine has. One: the caller's own, and nothing is set up.
  explicit Threads(int most);
  ~Threads();

  /// act(0) … act(count − 1), each once, in any order and some of them at the same time; returns when all are done.
  template <class Act>
  void for_each(std::size_t count, Act&& act) const {
    if (!pool_ || count == 1) {
      for (std::size_t k = 0; k < count; ++k) act(k);
      return;
    }
    using Type = std::remove_reference_t<Act>;
    run(
        count, [](void* of, std::size_t k) { (*static_cast<Type*>(of))(k); },
        const_cast<void*>(static_cast<const void*>(&act)));
  }

 private:
  using Call = void (*)(void*, std::size_t);
  void run(std::size_t count, Call call, void* of) const;

  struct Pool;
  std::unique_ptr<Pool> pool_;
};

}  // namespace diptych
