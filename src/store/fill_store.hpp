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
  std::int64_t samples = 0;  ///< number of samples that its motions took
};

/// One of `of` parts of a store: every `of`-th chunk, beginning with the chunk `number`, from 1.
struct StorePart {
  std::int64_t number = 1;
  std::int64_t of = 1;
};

/// Computation of the missing chunks of a store.
struct ChunkWork {
  std::string steps;  ///< label of the progress: "sweep, cells"
  /// Computes the chunk of a given number, on any thread. The result depends on the number alone.
  std::function<ChunkResult(std::int64_t)> compute;
  std::function<void(std::int64_t)> found = nullptr;  ///< called for each chunk already done
  bool verify = false;  ///< whether done chunks are read, and damaged ones computed again
  StorePart part = {};  ///< part of the store whose chunks are computed
};

/// Computes the missing chunks of a store on several threads. Other processes may fill the store at
/// the same time: a chunk that a running process has claimed is not taken. At the end each thread
/// waits for the chunks of others, or computes those that they abandon. On return all chunks of the
/// part are done.
///
/// Throws Interrupted, and the exceptions of `work.compute` and StoreFolder::put(). Finished chunks
/// remain.
void fill_store(const JobContext& context, const StoreFolder& store, const ChunkWork& work);

/// Creates or enters the store and fills it. If an exception ends it, reports on standard error how
/// many chunks are kept.
void fill_store(const JobContext& context, const StoreDescription& description,
                const ChunkWork& work);

/// Reports on standard error how many chunks of a store are kept; `how_to_go_on` ends the message.
void report_kept_chunks(const StoreFolder& store, const std::string& how_to_go_on) noexcept;

}  // namespace holdfast::program
