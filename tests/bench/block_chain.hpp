#pragma once
// Baseline for a sub-step of a chain: only factor and solve of a block tridiagonal matrix of 5 x 5
// blocks, J M^-1 J^T of a chain of hinges. Plain code with sizes known at compile time.

#include <array>
#include <cstddef>
#include <vector>

namespace substep::bench {

class BlockChain {
 public:
  /// A diagonally dominant matrix of n blocks.
  explicit BlockChain(std::size_t n) : matrix_(n), factor_(n), x_(n) {
    for (std::size_t b = 0; b < n; ++b) {
      for (std::size_t i = 0; i < kRows; ++i) {
        for (std::size_t j = 0; j < kRows; ++j) {
          const double s = 1.0 / static_cast<double>(1 + i + j + b % 3);
          matrix_[b].diagonal[i][j] = (i == j ? 4.0 : 0.0) + s;
          matrix_[b].below[i][j] = 0.3 * s;
        }
      }
    }
  }

  /// @return a number that depends on the whole solution
  double factor_and_solve() {
    const std::size_t n = matrix_.size();
    for (std::size_t b = 0; b < n; ++b) {
      factor_[b] = matrix_[b];
      for (double& x : x_[b]) x = 1.0;
      if (b > 0) subtract(factor_[b - 1], x_[b - 1], factor_[b], x_[b]);
      factor(factor_[b]);
      forward(factor_[b], x_[b]);
    }
    for (std::size_t b = n; b-- > 0;) {
      if (b + 1 < n) {
        for (std::size_t i = 0; i < kRows; ++i) {
          for (std::size_t k = 0; k < kRows; ++k) {
            x_[b][k] -= factor_[b].below[i][k] * factor_[b].inverse[k] * x_[b + 1][i];
          }
        }
      }
      backward(factor_[b], x_[b]);
    }
    return x_[0][0] + x_[n - 1][kRows - 1];
  }

 private:
  static constexpr std::size_t kRows = 5;
  using Square = std::array<std::array<double, kRows>, kRows>;
  using Column = std::array<double, kRows>;
  struct Block {
    Square diagonal;
    Square below;  // to the next block; factored: rows times L^-T
    Column inverse;
  };

  // D = L diag(d) L^T, and the rows below times L^-T.
  static void factor(Block& block) {
    Square& D = block.diagonal;
    for (std::size_t j = 0; j < kRows; ++j) {
      block.inverse[j] = 1.0 / D[j][j];
      for (std::size_t i = j + 1; i < kRows; ++i) {
        const double l = D[i][j] * block.inverse[j];
        for (std::size_t k = j + 1; k <= i; ++k) D[i][k] -= l * D[k][j];
      }
      for (std::size_t i = j + 1; i < kRows; ++i) D[i][j] *= block.inverse[j];
    }
    for (std::size_t k = 1; k < kRows; ++k) {
      for (std::size_t m = 0; m < k; ++m) {
        for (std::size_t i = 0; i < kRows; ++i) {
          block.below[i][k] -= block.below[i][m] * D[k][m];
        }
      }
    }
  }

  // The contribution that the previous block subtracts from this one.
  static void subtract(const Block& before, const Column& x_before, Block& block, Column& x) {
    Square weighted;
    for (std::size_t i = 0; i < kRows; ++i) {
      for (std::size_t k = 0; k < kRows; ++k) {
        weighted[i][k] = before.below[i][k] * before.inverse[k];
      }
    }
    for (std::size_t i = 0; i < kRows; ++i) {
      for (std::size_t k = 0; k < kRows; ++k) {
        x[i] -= weighted[i][k] * x_before[k];
        for (std::size_t j = 0; j <= i; ++j) {
          block.diagonal[i][j] -= weighted[i][k] * before.below[j][k];
        }
      }
    }
  }

  static void forward(const Block& block, Column& x) {
    for (std::size_t i = 1; i < kRows; ++i) {
      for (std::size_t m = 0; m < i; ++m) x[i] -= block.diagonal[i][m] * x[m];
    }
  }

  static void backward(const Block& block, Column& x) {
    for (std::size_t i = 0; i < kRows; ++i) x[i] *= block.inverse[i];
    for (std::size_t i = kRows - 1; i > 0; --i) {
      for (std::size_t m = 0; m < i; ++m) x[m] -= block.diagonal[i][m] * x[i];
    }
  }

  std::vector<Block> matrix_;
  std::vector<Block> factor_;
  std::vector<Column> x_;
};

}  // namespace substep::bench
