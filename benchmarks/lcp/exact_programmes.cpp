// Solves convex quadratic programmes exactly, by CGAL, as they come on standard input:
//     variables rows, then P (lower triangle and diagonal), c, G, h, all rationals as p/q,
//     then for each variable its lower and its upper bound, "-" where there is none.
// Prints a line each: "optimal" and x, "infeasible" or "unbounded".
#include <iostream>
#include <string>

#include <CGAL/Gmpq.h>
#include <CGAL/QP_functions.h>
#include <CGAL/QP_models.h>

using Number = CGAL::Gmpq;

static Number number() {
  std::string text;
  std::cin >> text;
  return Number(text);
}

int main() {
  for (int n, m; std::cin >> n >> m;) {
    CGAL::Quadratic_program<Number> programme(CGAL::SMALLER, false, 0, false, 0);
    for (int i = 0; i < n; i++)
      for (int j = 0; j <= i; j++) programme.set_d(i, j, number());
    for (int j = 0; j < n; j++) programme.set_c(j, number());
    for (int i = 0; i < m; i++)
      for (int j = 0; j < n; j++) programme.set_a(j, i, number());
    for (int i = 0; i < m; i++) programme.set_b(i, number());
    for (int j = 0; j < n; j++) {
      std::string lower, upper;
      std::cin >> lower >> upper;
      if (lower != "-") programme.set_l(j, true, Number(lower));
      if (upper != "-") programme.set_u(j, true, Number(upper));
    }
    const auto found = CGAL::solve_quadratic_program(programme, Number());
    if (found.is_optimal()) {
      std::cout << "optimal";
      for (auto x = found.variable_values_begin(); x != found.variable_values_end(); ++x)
        std::cout << " " << x->numerator() / x->denominator();
    } else {
      std::cout << (found.is_infeasible() ? "infeasible" : "unbounded");
    }
    std::cout << std::endl;
  }
}
