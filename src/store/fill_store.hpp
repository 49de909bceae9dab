#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "case/job_context.hpp"
#include "store/store_folder.hpp"

namespace holdfast::program {

/// Computed values of a chunk.
struct ChunkResult {
  ChunkValues values;
  std::int64_t samples = 0;  ///< of the motions of its cells
};

/// Every `of`-th chunk from number `number` on, both counted from 1: one of `of` parts of a store.
struct StorePart {
  std::int64_t number = 1;
  std::int64_t of = 1;
};

/// How the missing chunks of a store come to be.
struct ChunkWork {
  std::string steps;  ///< of the progress: "sweep, cells"
  /// Computes a chunk, on any thread. What a chunk becomes depends on its number alone.
  std::function<ChunkResult(std::int64_t)> compute;
  std::function<void(std::int64_t)> found = nullptr;  ///< told of each that was there; any thread
  bool verify = false;  ///< chunks that are there are read, and those that are damaged made anew
  StorePart part = {};  ///< the others are left
};

/// Computes what a store lacks. Its threads take one chunk after the other, and so do those of
/// other processes that fill the same store: none takes what a living one has, and at the end each
/// waits for what the others have, or does what they leave. All chunks of the part are there when
/// it returns.
///
/// Throws Interrupted, what a computation throws, and what StoreFolder::put() throws; every
/// finished chunk stays.
void fill_store(const JobContext& context, const StoreFolder& store, const ChunkWork& work);

/// Makes or enters the store and fills it. Says on standard error how much is kept where it does
/// not end.
void fill_store(const JobContext& context, const StoreDescription& description,
                const ChunkWork& work);

/// Says on standard error how much of a store is kept, after a fault.
void report_kept_chunks(const StoreFolder& store, const std::string& how_to_go_on) noexcept;

}  // namespace holdfast::program
