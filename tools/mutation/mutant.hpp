// The functions that replace operators in the mutated copies of the sources. The environment
// variable WR_MUTANT contains the number of one mutant. Each call of a function is the place of one
// or more mutants. If WR_MUTANT contains the number of another mutant, the call returns the
// original value.

#pragma once

#include <cstdlib>

namespace mutant {

/// @brief Returns the number of the active mutant. 0 means that no mutant is active.
inline int active() {
  static const int number = [] {
    const char* text = std::getenv("WR_MUTANT");
    return text == nullptr ? 0 : std::atoi(text);
  }();
  return number;
}

inline bool on(int number) {
  return active() == number;
}

/// @brief Returns the value that is added to a constant: 1, -1 or 0.
inline int offset(int number) {
  return on(number) ? 1 : on(number + 1) ? -1 : 0;
}

template <class A, class B>
bool less(int number, const A& a, const B& b) {
  return on(number) ? a <= b : on(number + 1) ? a >= b : a < b;
}

template <class A, class B>
bool greater(int number, const A& a, const B& b) {
  return on(number) ? a >= b : on(number + 1) ? a <= b : a > b;
}

template <class A, class B>
bool lessOrEqual(int number, const A& a, const B& b) {
  return on(number) ? a < b : on(number + 1) ? a > b : a <= b;
}

template <class A, class B>
bool greaterOrEqual(int number, const A& a, const B& b) {
  return on(number) ? a > b : on(number + 1) ? a < b : a >= b;
}

template <class A, class B>
bool equal(int number, const A& a, const B& b) {
  return on(number) != (a == b);
}

template <class A, class B>
bool unequal(int number, const A& a, const B& b) {
  return on(number) != (a != b);
}

template <class A, class B>
auto plus(int number, const A& a, const B& b) -> decltype(a + b) {
  return on(number) ? a - b : a + b;
}

template <class A, class B>
auto minus(int number, const A& a, const B& b) -> decltype(a - b) {
  return on(number) ? a + b : a - b;
}

template <class A, class B>
auto times(int number, const A& a, const B& b) -> decltype(a * b) {
  return on(number) ? a / b : a * b;
}

template <class A, class B>
auto divided(int number, const A& a, const B& b) -> decltype(a / b) {
  return on(number) ? a * b : a / b;
}

template <class A, class B>
auto remainder(int number, const A& a, const B& b) -> decltype(a % b) {
  return on(number) ? a * b : a % b;
}

template <class A, class B>
auto bothBits(int number, const A& a, const B& b) -> decltype(a & b) {
  return on(number) ? a | b : a & b;
}

template <class A, class B>
auto eitherBits(int number, const A& a, const B& b) -> decltype(a | b) {
  return on(number) ? a & b : a | b;
}

template <class A, class B>
auto shiftedLeft(int number, const A& a, const B& b) -> decltype(a << b) {
  return on(number) ? a >> b : a << b;
}

template <class A, class B>
auto shiftedRight(int number, const A& a, const B& b) -> decltype(a >> b) {
  return on(number) ? a << b : a >> b;
}

}  // namespace mutant
