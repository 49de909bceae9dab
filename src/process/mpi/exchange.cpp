#include "process/mpi/exchange.hpp"

#include <climits>
#include <cstdint>

#include "process/errors.hpp"
#include "process/interrupt.hpp"

namespace holdfast::program::mpi {
namespace {

std::size_t size_of(MPI_Comm processes) {
  int size = 0;
  MPI_Comm_size(processes, &size);
  return static_cast<std::size_t>(size);
}

}  // namespace

Exchange::Exchange(Session& session, MPI_Comm processes, const std::string& text)
    : session_(session),
      processes_(processes),
      sent_(text.size() <= INT_MAX ? text : std::string()),
      length_(text.size() <= INT_MAX ? static_cast<int>(text.size()) : -1),
      lengths_(size_of(processes), 0) {}

std::vector<std::string> Exchange::texts() {
  wait_for([this](MPI_Request* request) {
    return MPI_Iallgather(&length_, 1, MPI_INT, lengths_.data(), 1, MPI_INT, processes_, request);
  });
  place_texts();
  wait_for([this](MPI_Request* request) {
    return MPI_Iallgatherv(sent_.data(), length_, MPI_BYTE, received_.data(), lengths_.data(),
                           starts_.data(), MPI_BYTE, processes_, request);
  });
  std::vector<std::string> texts;
  for (std::size_t k = 0; k < lengths_.size(); ++k) {
    texts.push_back(received_.substr(static_cast<std::size_t>(starts_[k]),
                                     static_cast<std::size_t>(lengths_[k])));
  }
  return texts;
}

/// Every process knows all lengths, so that either all refuse or none.
void Exchange::place_texts() {
  std::int64_t end = 0;
  for (const int length : lengths_) {
    starts_.push_back(static_cast<int>(end));
    end += length;
    if (length < 0 || end > INT_MAX) {
      throw NoAnswer("the processes have more to tell each other than the 2 GiB that MPI carries");
    }
  }
  received_.resize(static_cast<std::size_t>(end));
}

void Exchange::wait_for(const Start& start) {
  {
    const auto guard = session_.lock();
    check(start(&request_), "exchange texts");
  }
  for (Pause pause; !session_.completed(request_); pause.take()) throw_if_interrupted();
}

}  // namespace holdfast::program::mpi
