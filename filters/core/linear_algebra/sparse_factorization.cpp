// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// The only source that knows MUMPS. Its sequential library brings stand-ins for MPI that would take
// the place of the real ones in a process that uses both, so it is loaded into a scope of its own.

#include "linear_algebra/sparse_factorization.h"

#include <dlfcn.h>
#include <dmumps_c.h>

#include <cmath>
#include <new>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

namespace palpate {
namespace {

constexpr const char* kLibrary = PALPATE_MUMPS_LIBRARY;

using Call = decltype(&::dmumps_c);

Call loadMumps() {
  void* library = dlopen(kLibrary, RTLD_NOW | RTLD_LOCAL | RTLD_DEEPBIND);
  if (!library)
    throw std::runtime_error(
        std::string(
            "finite elements and shells need the library MUMPS (Debian: libmumps-seq-5.5): ") +
        dlerror());
  const auto call = reinterpret_cast<Call>(dlsym(library, "dmumps_c"));
  if (!call) throw std::runtime_error(std::string(kLibrary) + " has no function dmumps_c");
  return call;
}

Call mumps() {
  static const Call call = loadMumps();
  return call;
}

// The library's jobs and controls, counted from 1 as in its guide.
enum Job { Begin = -1, End = -2, Analyse = 1, Factor = 2, Solve = 3 };
constexpr int kUseWorld = -987654;
enum Control {
  Permutation = 6,
  Ordering = 7,
  Compression = 12,
  ExtraMemoryPercent = 14,
  Schur = 19,
  RightHandSides = 20,
  FindNullPivots = 24
};
enum RightHandSide { Dense = 0, OfFewEntries = 3 };
enum Orderings { GivenOrder = 1, Scotch = 3 };
enum Answer {
  Error = 1,
  ErrorDetail = 2,
  NegativePivots = 12,
  PeakMegabytes = 22,
  NullPivots = 28
};

[[noreturn]] void fail(int error, int detail) {
  if (error == -13 || error == -7) throw std::bad_alloc();
  if (error == -10 || error == -6)
    throw SingularSystem("the sparse system is singular: a part of the body is not held");
  std::ostringstream text;
  text << "the sparse system could not be factored (MUMPS error " << error << ", " << detail << ")";
  throw std::runtime_error(text.str());
}

}  // namespace

struct SparseFactorization::Instance {
  explicit Instance(bool definite) : call(mumps()) {
    id.sym = definite ? 1 : 2;
    id.par = 1;
    id.comm_fortran = kUseWorld;
    run(Begin);
    for (int stream = 0; stream < 4; ++stream) id.icntl[stream] = stream < 3 ? -1 : 0;
  }
  ~Instance() {
    id.job = End;
    call(&id);
  }
  Instance(const Instance&) = delete;

  int answer(Answer number) const { return id.infog[number - 1]; }
  void control(Control number, int value) { id.icntl[number - 1] = value; }

  void run(Job job) {
    id.job = job;
    call(&id);
    if (answer(Error) < 0) fail(answer(Error), answer(ErrorDetail));
  }

  /// Factors, with more working space where pivoting needs it.
  void factor() {
    constexpr int workspaceTooSmall = -9, lastPercent = 1600;
    for (int percent = 30;; percent *= 3) {
      control(ExtraMemoryPercent, percent);
      id.job = Factor;
      call(&id);
      const int error = answer(Error);
      if (error >= 0) return;
      if ((error != workspaceTooSmall && error != workspaceTooSmall + 1) || percent > lastPercent)
        fail(error, answer(ErrorDetail));
    }
  }

  /// The places, from 1, of the first rows in an order that fills in little.
  std::vector<int> orderOfUnknowns(int rows, bool definite) const {
    std::vector<int> row, column;
    for (std::size_t i = 0; i < matrix.row.size(); ++i)
      if (matrix.row[i] <= rows && matrix.column[i] <= rows) {
        row.push_back(matrix.row[i]);
        column.push_back(matrix.column[i]);
      }
    Instance analysis(definite);
    analysis.id.n = rows;
    analysis.id.nnz = static_cast<MUMPS_INT8>(row.size());
    analysis.id.irn = row.data();
    analysis.id.jcn = column.data();
    analysis.control(Ordering, Scotch);
    analysis.control(Permutation, 0);  // both would look at values, of which there are none yet
    analysis.control(Compression, 1);
    analysis.run(Analyse);
    return std::vector<int>(analysis.id.sym_perm, analysis.id.sym_perm + rows);
  }

  Call call;
  DMUMPS_STRUC_C id{};
  SymmetricEntries matrix;
  std::vector<int> keptRows;
};

SparseFactorization::SparseFactorization(SymmetricEntries matrix, int kept, bool definite)
    : instance_(new Instance(definite)) {
  Instance& own = *instance_;
  own.matrix = std::move(matrix);
  for (int& i : own.matrix.row) ++i;
  for (int& j : own.matrix.column) ++j;
  own.id.n = own.matrix.size;
  own.id.nnz = static_cast<MUMPS_INT8>(own.matrix.value.size());
  own.id.irn = own.matrix.row.data();
  own.id.jcn = own.matrix.column.data();
  own.id.a = own.matrix.value.data();
  // The library orders rows by itself only where none is kept (SCOTCH's nested dissection).
  own.control(Ordering, kept > 0 ? GivenOrder : Scotch);
  std::vector<int> order;
  if (kept > 0) {
    own.keptRows.resize(kept);
    std::iota(own.keptRows.begin(), own.keptRows.end(), own.matrix.size - kept + 1);
    schur_.resize(kept, kept);
    own.control(Schur, 1);
    own.control(FindNullPivots, 1);  // they would be left out of the complement without a word
    own.id.size_schur = kept;
    own.id.listvar_schur = own.keptRows.data();
    own.id.schur = schur_.data();
    order = own.orderOfUnknowns(own.matrix.size - kept, definite);
    order.insert(order.end(), own.keptRows.begin(), own.keptRows.end());
    own.id.perm_in = order.data();
  }
  own.run(Analyse);
  own.factor();
  // The library writes the lower triangle row by row: the upper one column by column.
  if (kept > 0) schur_.triangularView<Eigen::StrictlyLower>() = schur_.transpose();
  if (definite && own.answer(NegativePivots) > 0)
    throw SingularSystem("the stiffness matrix of the body is not positive definite");
  if (own.answer(NullPivots) > 0 || !schur_.allFinite())
    throw SingularSystem("the sparse system is singular: a part of the body is not held");
}

SparseFactorization::~SparseFactorization() = default;

void SparseFactorization::solve(Eigen::Ref<Eigen::MatrixXd> columns) const {
  Instance& own = *instance_;
  own.id.rhs = columns.data();
  own.id.nrhs = static_cast<int>(columns.cols());
  own.id.lrhs = static_cast<int>(columns.outerStride());
  own.run(Solve);
}

void SparseFactorization::solveUnits(const std::vector<int>& rows,
                                     Eigen::Ref<Eigen::MatrixXd> out) const {
  Instance& own = *instance_;
  std::vector<int> places, starts;
  for (int row : rows) {
    starts.push_back(static_cast<int>(places.size()) + 1);
    if (row >= 0) places.push_back(row + 1);
  }
  starts.push_back(static_cast<int>(places.size()) + 1);
  out.setZero();
  if (places.empty()) return;
  std::vector<double> ones(places.size(), 1);
  own.id.nz_rhs = static_cast<int>(places.size());
  own.id.rhs_sparse = ones.data();
  own.id.irhs_sparse = places.data();
  own.id.irhs_ptr = starts.data();
  own.control(RightHandSides, OfFewEntries);
  own.id.rhs = out.data();
  own.id.nrhs = static_cast<int>(out.cols());
  own.id.lrhs = static_cast<int>(out.outerStride());
  own.id.job = Solve;
  own.call(&own.id);
  own.control(RightHandSides, Dense);
  if (own.answer(Error) < 0) fail(own.answer(Error), own.answer(ErrorDetail));
}

int SparseFactorization::negativePivots() const {
  return instance_->answer(NegativePivots);
}

std::size_t SparseFactorization::peakBytes() const {
  return std::size_t(instance_->answer(PeakMegabytes)) * 1000000 +
         instance_->matrix.value.size() * (sizeof(double) + 2 * sizeof(int));
}

bool SparseFactorization::isAvailable() {
  return true;
}

}  // namespace palpate
