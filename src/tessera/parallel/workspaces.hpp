#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <vector>

namespace tessera::parallel {

/// Objects that are dear to make and serve one thread at a time: as many as threads ask for at once, kept for the next.
template <class T>
class Workspaces {
 public:
  explicit Workspaces(std::function<std::unique_ptr<T>()> make) : make_(std::move(make)) {}

  /// Holds one object until the end of its life.
  class Lease {
   public:
    explicit Lease(Workspaces& all) : all_(all), object_(all.take()) {}
    Lease(const Lease&) = delete;
    Lease& operator=(const Lease&) = delete;
    ~Lease() { all_.give_back(std::move(object_)); }
    T& operator*() const { return *object_; }
    T* operator->() const { return object_.get(); }

   private:
    Workspaces& all_;
    std::unique_ptr<T> object_;
  };

 private:
  std::unique_ptr<T> take() {
    {
      const std::lock_guard lock(mutex_);
      if (!free_.empty()) {
        std::unique_ptr<T> object = std::move(free_.back());
        free_.pop_back();
        return object;
      }
    }
    return make_();
  }
  void give_back(std::unique_ptr<T> object) {
    const std::lock_guard lock(mutex_);
    free_.push_back(std::move(object));
  }

  std::function<std::unique_ptr<T>()> make_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<T>> free_;
};

}  // namespace tessera::parallel
