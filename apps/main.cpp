#include "job.hpp"

int main(int argument_count, char** arguments) {
  holdfast::program::install_signal_handlers();
  return holdfast::program::run_program(argument_count, arguments);
}
