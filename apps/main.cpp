#include "interrupt.hpp"
#include "job.hpp"

int main(int argument_count, char** arguments) {
  holdfast::program::install_signal_handlers();
  return holdfast::program::run_program({arguments + 1, arguments + argument_count});
}
