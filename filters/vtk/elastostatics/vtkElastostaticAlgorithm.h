// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkElastostaticAlgorithm
 * @brief what the filters of Palpate have in common: polydata in, polydata out, one way to fail
 *
 * A filter that cannot do its work reports one sentence as an error event (which also prints it unless
 * somebody observes the event), keeps it as FailureMessage, and leaves its output empty. Abort requests
 * are honoured wherever progress is reported.
 */

#ifndef vtkElastostaticAlgorithm_h
#define vtkElastostaticAlgorithm_h

#include "PalpateElastostaticsModule.h" // for the export macro
#include "vtkPolyDataAlgorithm.h"

#include <string> // for the message

class PALPATEELASTOSTATICS_EXPORT vtkElastostaticAlgorithm : public vtkPolyDataAlgorithm
{
public:
  vtkAbstractTypeMacro(vtkElastostaticAlgorithm, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * The sentence of the last execution's failure, empty if it succeeded.
   */
  const char* GetFailureMessage() const { return this->FailureMessage.c_str(); }

protected:
  vtkElastostaticAlgorithm() = default;
  ~vtkElastostaticAlgorithm() override = default;

  int RequestData(vtkInformation* request, vtkInformationVector** inputs,
    vtkInformationVector* outputs) override;

  /**
   * The filter's work. The output starts as a shallow copy of the input, which is null where
   * the first port does not take polydata. Throws what the core throws.
   */
  virtual void Compute(vtkPolyData* input, vtkPolyData* output, vtkInformationVector** inputs) = 0;

  /**
   * Reports progress; true to go on, false if the execution shall be aborted.
   */
  bool ReportProgress(double fraction, const char* stage);

  /**
   * Sets a name, null for none; the same name again modifies nothing.
   */
  void SetName(std::string& member, const char* name);

private:
  vtkElastostaticAlgorithm(const vtkElastostaticAlgorithm&) = delete;
  void operator=(const vtkElastostaticAlgorithm&) = delete;

  std::string FailureMessage;
};

#endif
