/* Names of SUNDIALS 7 for the older versions that hooke takes, and a context that prints nothing: what
 * differs between the versions stands here alone. */
#pragma once

#include <sundials/sundials_config.h>
#include <sundials/sundials_context.h>
#if SUNDIALS_VERSION_MAJOR >= 7
#include <sundials/sundials_errors.h>
#endif

/* Keeps the last complaint of a solver; `own` is a struct hk_sundials. */
void hk_sundials_complain(void *own, const char *message);

#if SUNDIALS_VERSION_MAJOR < 7 || (SUNDIALS_VERSION_MAJOR == 7 && SUNDIALS_VERSION_MINOR < 1)
#define ARKodeEvolve                 ARKStepEvolve
#define ARKodeFree                   ARKStepFree
#define ARKodeGetNonlinSolvStats     ARKStepGetNonlinSolvStats
#define ARKodeGetNonlinearSystemData ARKStepGetNonlinearSystemData
#define ARKodeGetNumErrTestFails     ARKStepGetNumErrTestFails
#define ARKodeGetNumLinIters         ARKStepGetNumLinIters
#define ARKodeGetNumSteps            ARKStepGetNumSteps
#define ARKodeSVtolerances           ARKStepSVtolerances
#define ARKodeSetEpsLin              ARKStepSetEpsLin
#define ARKodeSetInterpolantType     ARKStepSetInterpolantType
#define ARKodeSetJacTimes            ARKStepSetJacTimes
#define ARKodeSetLinearSolver        ARKStepSetLinearSolver
#define ARKodeSetMaxErrTestFails     ARKStepSetMaxErrTestFails
#define ARKodeSetPredictorMethod     ARKStepSetPredictorMethod
#define ARKodeSetStopTime            ARKStepSetStopTime
#define ARKodeSetUserData            ARKStepSetUserData
#endif

#if SUNDIALS_VERSION_MAJOR < 7

#define SUN_SUCCESS 0

static inline void hk_sundials_message(int code, const char *module, const char *function, char *message,
                                       void *own) {
  (void)code, (void)module, (void)function;
  hk_sundials_complain(own, message);
}

/* Each solver takes the handler of its messages. */
#define HOOKE_CVODE_LISTEN(memory, own)  CVodeSetErrHandlerFn(memory, hk_sundials_message, own)
#define HOOKE_ARKODE_LISTEN(memory, own) ARKStepSetErrHandlerFn(memory, hk_sundials_message, own)

static inline int hk_sundials_context(SUNContext *context, void *own) {
  (void)own;
  return SUNContext_Create(NULL, context);
}

#else

static inline void hk_sundials_message(int line, const char *function, const char *file, const char *message,
                                       SUNErrCode code, void *own, SUNContext context) {
  (void)line, (void)function, (void)file, (void)code, (void)context;
  hk_sundials_complain(own, message);
}

/* The context has the handler of messages for all its solvers. */
#define HOOKE_CVODE_LISTEN(memory, own)  ((void)(memory), (void)(own), CV_SUCCESS)
#define HOOKE_ARKODE_LISTEN(memory, own) ((void)(memory), (void)(own), ARK_SUCCESS)

/* Without the handler and the logger that are there, which print to stderr. */
static inline int hk_sundials_context(SUNContext *context, void *own) {
  int flag = SUNContext_Create(SUN_COMM_NULL, context);
  if (flag == SUN_SUCCESS) flag = SUNContext_ClearErrHandlers(*context);
  if (flag == SUN_SUCCESS) flag = SUNContext_SetLogger(*context, NULL);
  return flag == SUN_SUCCESS ? SUNContext_PushErrHandler(*context, hk_sundials_message, own) : flag;
}

#endif
