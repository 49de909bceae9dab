#pragma once

#include <functional>
#include <string>
#include <vector>

#include "process/mpi/session.hpp"

namespace holdfast::program::mpi {

/// One exchange of texts between all processes of a communicator, as ProcessGroup::exchange().
///
/// An interruption leaves it unfinished, and MPI then still reads and writes its members: it has to
/// live as long as MPI is called.
class Exchange {
 public:
  Exchange(Session& session, MPI_Comm processes, const std::string& text);

  /// Waits for the others. To be called once.
  std::vector<std::string> texts();

  /// Whether MPI has done with the members.
  bool finished() { return session_.completed(request_); }

 private:
  using Start = std::function<int(MPI_Request*)>;

  void wait_for(const Start& start);
  void place_texts();

  Session& session_;
  MPI_Comm processes_;
  MPI_Request request_ = MPI_REQUEST_NULL;
  std::string sent_, received_;
  int length_;  // of the own text; −1: more than MPI counts
  std::vector<int> lengths_, starts_;
};

}  // namespace holdfast::program::mpi
