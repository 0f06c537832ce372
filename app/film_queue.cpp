// SPDX-License-Identifier: MIT
#include "film_queue.hpp"

namespace estampe::app {

FilmQueue::FilmQueue(const FilmFrames& frames, FilmWriter* film)
    : frames_(frames), film_(film), thread_([this] { work(); })
{
}

FilmQueue::~FilmQueue()
{
    {
        const std::lock_guard lock(guard_);
        waiting_.clear();
        is_closed_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void FilmQueue::push(Frame frame)
{
    constexpr size_t most_waiting = 3;
    std::unique_lock lock(guard_);
    changed_.wait(lock, [&] { return waiting_.size() < most_waiting || problem_ != nullptr; });
    rethrow_problem();
    waiting_.push_back(std::move(frame));
    changed_.notify_all();
}

void FilmQueue::finish()
{
    std::unique_lock lock(guard_);
    changed_.wait(lock, [&] { return (waiting_.empty() && is_idle_) || problem_ != nullptr; });
    rethrow_problem();
}

void FilmQueue::rethrow_problem()
{
    if (problem_ != nullptr) {
        std::rethrow_exception(problem_);
    }
}

void FilmQueue::work()
{
    std::unique_lock lock(guard_);
    while (true) {
        changed_.wait(lock, [&] { return !waiting_.empty() || is_closed_; });
        if (waiting_.empty()) {
            return;
        }
        const Frame frame = std::move(waiting_.front());
        waiting_.pop_front();
        is_idle_ = false;
        lock.unlock();
        std::exception_ptr problem;
        try {
            frames_.save(frame.number, frame.image);
            if (film_ != nullptr) {
                film_->add(frame.image);
            }
            if (frame.memory) {
                frames_.save_state({frame.number + 1, *frame.memory});
            }
        } catch (...) {
            problem = std::current_exception();
        }
        lock.lock();
        is_idle_ = true;
        if (problem != nullptr) {
            problem_ = problem;
            waiting_.clear();
        }
        changed_.notify_all();
    }
}

} // namespace estampe::app
