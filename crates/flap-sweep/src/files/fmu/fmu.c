/* Functional mock-up unit (FMI 3.0) of a linear model x' = A x + B s, for Model Exchange and Co-Simulation.

   model.h contains the sizes, the matrix [A B] and the constants. The value references count the variables in this
   order: time, states x, inputs s, derivatives x', constants. */

#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "fmi3Functions.h"
#include "model.h"

#if defined(_MSC_VER)
#pragma warning(disable : 4100) /* unused parameters */
#elif defined(__GNUC__)
#pragma GCC diagnostic ignored "-Wunused-parameter"
#endif

#define KNOWNS (STATES + INPUTS)

/* Value references. */
#define FIRST_KNOWN 1
#define FIRST_DERIVATIVE (FIRST_KNOWN + KNOWNS)
#define FIRST_CONSTANT (FIRST_DERIVATIVE + STATES)
#define VARIABLES (FIRST_CONSTANT + sizeof CONSTANTS / sizeof CONSTANTS[0])

typedef struct {
    double time;
    double knowns[KNOWNS]; /* states, then inputs */
    fmi3InstanceEnvironment environment;
    fmi3LogMessageCallback log;
} Model;

static fmi3Status fail(fmi3Instance instance, const char *message) {
    const Model *model = instance;
    if (model->log) {
        model->log(model->environment, fmi3Error, "logStatusError", message);
    }
    return fmi3Error;
}

/* Returns the derivative of a state. */
static double derivative(const double knowns[], size_t state) {
    double sum = 0.0;
    for (size_t i = 0; i < KNOWNS; i++) {
        sum += MATRIX[state][i] * knowns[i];
    }
    return sum;
}

/* Computes the states after a time with constant inputs.

   The Taylor series of the exact solution is evaluated in steps of at most 1 / NORM, where NORM is the largest row sum
   of |A|. The remainder after 20 terms is smaller than the rounding error. */
static void advance(double knowns[], double time) {
    double steps = 1.0;
    while (steps < NORM * time) {
        steps *= 2.0;
    }
    for (double step = 0.0; step < steps; step++) {
        double term[KNOWNS];
        memcpy(term, knowns, sizeof term);
        for (int order = 1; order <= 20; order++) {
            double next[KNOWNS] = {0.0}; /* The derivatives of the inputs are zero. */
            for (size_t i = 0; i < STATES; i++) {
                next[i] = derivative(term, i) * time / steps / order;
                knowns[i] += next[i];
            }
            memcpy(term, next, sizeof term);
        }
    }
}

/* Instances. */

static fmi3Instance instantiate(fmi3String token, fmi3InstanceEnvironment environment, fmi3LogMessageCallback log) {
    Model *model = calloc(1, sizeof *model);
    if (!model) {
        return NULL;
    }
    model->environment = environment;
    model->log = log;
    if (!token || strcmp(token, TOKEN) != 0) {
        fail(model, "the instantiation token belongs to another model");
        free(model);
        return NULL;
    }
    return model;
}

#define NAMES fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible, fmi3Boolean logging
#define LOG fmi3InstanceEnvironment environment, fmi3LogMessageCallback log

fmi3Instance fmi3InstantiateModelExchange(NAMES, LOG) { return instantiate(token, environment, log); }

fmi3Instance fmi3InstantiateCoSimulation(NAMES, fmi3Boolean has_events, fmi3Boolean returns_early,
                                         const fmi3ValueReference references[], size_t count, LOG,
                                         fmi3IntermediateUpdateCallback update) {
    return instantiate(token, environment, log);
}

fmi3Instance fmi3InstantiateScheduledExecution(NAMES, LOG, fmi3ClockUpdateCallback update,
                                               fmi3LockPreemptionCallback lock, fmi3UnlockPreemptionCallback unlock) {
    return NULL;
}

void fmi3FreeInstance(fmi3Instance instance) { free(instance); }

const char *fmi3GetVersion(void) { return fmi3Version; }

/* Functions for both interfaces. */

#define SELF fmi3Instance instance
#define REFERENCES const fmi3ValueReference references[], size_t count

fmi3Status fmi3EnterInitializationMode(SELF, fmi3Boolean has_tolerance, fmi3Float64 tolerance, fmi3Float64 start,
                                       fmi3Boolean has_stop, fmi3Float64 stop) {
    return fmi3SetTime(instance, start);
}

fmi3Status fmi3Reset(SELF) {
    Model *model = instance;
    model->time = 0.0;
    memset(model->knowns, 0, sizeof model->knowns);
    return fmi3OK;
}

fmi3Status fmi3GetFloat64(SELF, REFERENCES, fmi3Float64 values[], size_t size) {
    const Model *model = instance;
    for (size_t i = 0; i < count; i++) {
        const fmi3ValueReference reference = references[i];
        if (reference < FIRST_KNOWN) {
            values[i] = model->time;
        } else if (reference < FIRST_DERIVATIVE) {
            values[i] = model->knowns[reference - FIRST_KNOWN];
        } else if (reference < FIRST_CONSTANT) {
            values[i] = derivative(model->knowns, reference - FIRST_DERIVATIVE);
        } else if (reference < VARIABLES) {
            values[i] = CONSTANTS[reference - FIRST_CONSTANT];
        } else {
            return fail(instance, "fmi3GetFloat64: no variable has this value reference");
        }
    }
    return fmi3OK;
}

fmi3Status fmi3SetFloat64(SELF, REFERENCES, const fmi3Float64 values[], size_t size) {
    Model *model = instance;
    for (size_t i = 0; i < count; i++) {
        if (references[i] < FIRST_KNOWN || references[i] >= FIRST_DERIVATIVE) {
            return fail(instance, "fmi3SetFloat64: only states and inputs can be set");
        }
        model->knowns[references[i] - FIRST_KNOWN] = values[i];
    }
    return fmi3OK;
}

/* The model is linear, so the derivative in a direction is the value of the variables at this direction. */
fmi3Status fmi3GetDirectionalDerivative(SELF, REFERENCES, const fmi3ValueReference knowns[], size_t known_count,
                                        const fmi3Float64 seed[], size_t seed_size, fmi3Float64 values[], size_t size) {
    Model direction = *(const Model *)instance;
    fmi3Reset(&direction);
    const fmi3Status status = fmi3SetFloat64(&direction, knowns, known_count, seed, seed_size);
    return status == fmi3OK ? fmi3GetFloat64(&direction, references, count, values, size) : status;
}

/* Model Exchange. */

fmi3Status fmi3SetTime(SELF, fmi3Float64 time) {
    ((Model *)instance)->time = time;
    return fmi3OK;
}

fmi3Status fmi3GetNumberOfContinuousStates(SELF, size_t *count) {
    *count = STATES;
    return fmi3OK;
}

fmi3Status fmi3GetNumberOfEventIndicators(SELF, size_t *count) {
    *count = 0;
    return fmi3OK;
}

fmi3Status fmi3GetContinuousStates(SELF, fmi3Float64 states[], size_t count) {
    memcpy(states, ((const Model *)instance)->knowns, STATES * sizeof states[0]);
    return fmi3OK;
}

fmi3Status fmi3SetContinuousStates(SELF, const fmi3Float64 states[], size_t count) {
    memcpy(((Model *)instance)->knowns, states, STATES * sizeof states[0]);
    return fmi3OK;
}

fmi3Status fmi3GetContinuousStateDerivatives(SELF, fmi3Float64 derivatives[], size_t count) {
    for (size_t i = 0; i < STATES; i++) {
        derivatives[i] = derivative(((const Model *)instance)->knowns, i);
    }
    return fmi3OK;
}

fmi3Status fmi3GetNominalsOfContinuousStates(SELF, fmi3Float64 nominals[], size_t count) {
    for (size_t i = 0; i < STATES; i++) {
        nominals[i] = 1.0;
    }
    return fmi3OK;
}

fmi3Status fmi3CompletedIntegratorStep(SELF, fmi3Boolean is_final, fmi3Boolean *enter_events, fmi3Boolean *terminate) {
    *enter_events = *terminate = false;
    return fmi3OK;
}

fmi3Status fmi3UpdateDiscreteStates(SELF, fmi3Boolean *update, fmi3Boolean *terminate, fmi3Boolean *nominals,
                                    fmi3Boolean *values, fmi3Boolean *has_next, fmi3Float64 *next) {
    *update = *terminate = *nominals = *values = *has_next = false;
    return fmi3OK;
}

/* Co-Simulation. */

fmi3Status fmi3DoStep(SELF, fmi3Float64 time, fmi3Float64 step, fmi3Boolean is_final, fmi3Boolean *handle_events,
                      fmi3Boolean *terminate, fmi3Boolean *early, fmi3Float64 *last_time) {
    Model *model = instance;
    *handle_events = *terminate = *early = false;
    *last_time = time;
    if (!(step > 0.0 && step <= DBL_MAX)) {
        return fail(instance, "fmi3DoStep: the step size must be positive");
    }
    advance(model->knowns, step);
    model->time = *last_time = time + step;
    return fmi3OK;
}

/* Functions without effect. */

#define NO_EFFECT(function, ...) fmi3Status function(__VA_ARGS__) { return fmi3OK; }

NO_EFFECT(fmi3SetDebugLogging, SELF, fmi3Boolean on, size_t count, const fmi3String categories[])
NO_EFFECT(fmi3ExitInitializationMode, SELF)
NO_EFFECT(fmi3EnterEventMode, SELF)
NO_EFFECT(fmi3EnterContinuousTimeMode, SELF)
NO_EFFECT(fmi3EnterStepMode, SELF)
NO_EFFECT(fmi3GetEventIndicators, SELF, fmi3Float64 indicators[], size_t count)
NO_EFFECT(fmi3Terminate, SELF)

/* Functions that the model description does not offer. */

#define UNSUPPORTED(function, ...) \
    fmi3Status function(__VA_ARGS__) { return fail(instance, #function " is not supported"); }
#define NO_VARIABLES(Type) \
    UNSUPPORTED(fmi3Get##Type, SELF, REFERENCES, fmi3##Type values[], size_t size) \
    UNSUPPORTED(fmi3Set##Type, SELF, REFERENCES, const fmi3##Type values[], size_t size)

NO_VARIABLES(Float32) NO_VARIABLES(Boolean) NO_VARIABLES(String)
NO_VARIABLES(Int8) NO_VARIABLES(Int16) NO_VARIABLES(Int32) NO_VARIABLES(Int64)
NO_VARIABLES(UInt8) NO_VARIABLES(UInt16) NO_VARIABLES(UInt32) NO_VARIABLES(UInt64)

UNSUPPORTED(fmi3GetBinary, SELF, REFERENCES, size_t sizes[], fmi3Binary values[], size_t size)
UNSUPPORTED(fmi3SetBinary, SELF, REFERENCES, const size_t sizes[], const fmi3Binary values[], size_t size)
UNSUPPORTED(fmi3GetClock, SELF, REFERENCES, fmi3Clock values[])
UNSUPPORTED(fmi3SetClock, SELF, REFERENCES, const fmi3Clock values[])
UNSUPPORTED(fmi3GetIntervalDecimal, SELF, REFERENCES, fmi3Float64 values[], fmi3IntervalQualifier kinds[])
UNSUPPORTED(fmi3SetIntervalDecimal, SELF, REFERENCES, const fmi3Float64 values[])
UNSUPPORTED(fmi3GetIntervalFraction, SELF, REFERENCES, fmi3UInt64 n[], fmi3UInt64 d[], fmi3IntervalQualifier kinds[])
UNSUPPORTED(fmi3SetIntervalFraction, SELF, REFERENCES, const fmi3UInt64 n[], const fmi3UInt64 d[])
UNSUPPORTED(fmi3GetShiftDecimal, SELF, REFERENCES, fmi3Float64 values[])
UNSUPPORTED(fmi3SetShiftDecimal, SELF, REFERENCES, const fmi3Float64 values[])
UNSUPPORTED(fmi3GetShiftFraction, SELF, REFERENCES, fmi3UInt64 n[], fmi3UInt64 d[])
UNSUPPORTED(fmi3SetShiftFraction, SELF, REFERENCES, const fmi3UInt64 n[], const fmi3UInt64 d[])
UNSUPPORTED(fmi3GetNumberOfVariableDependencies, SELF, fmi3ValueReference dependent, size_t *count)
UNSUPPORTED(fmi3GetVariableDependencies, SELF, fmi3ValueReference dependent, size_t elements[],
            fmi3ValueReference independents[], size_t independent_elements[], fmi3DependencyKind kinds[], size_t count)
UNSUPPORTED(fmi3GetAdjointDerivative, SELF, REFERENCES, const fmi3ValueReference knowns[], size_t known_count,
            const fmi3Float64 seed[], size_t seed_size, fmi3Float64 values[], size_t size)
UNSUPPORTED(fmi3GetOutputDerivatives, SELF, REFERENCES, const fmi3Int32 orders[], fmi3Float64 values[], size_t size)
UNSUPPORTED(fmi3GetFMUState, SELF, fmi3FMUState *state)
UNSUPPORTED(fmi3SetFMUState, SELF, fmi3FMUState state)
UNSUPPORTED(fmi3FreeFMUState, SELF, fmi3FMUState *state)
UNSUPPORTED(fmi3SerializedFMUStateSize, SELF, fmi3FMUState state, size_t *size)
UNSUPPORTED(fmi3SerializeFMUState, SELF, fmi3FMUState state, fmi3Byte bytes[], size_t size)
UNSUPPORTED(fmi3DeserializeFMUState, SELF, const fmi3Byte bytes[], size_t size, fmi3FMUState *state)
UNSUPPORTED(fmi3EnterConfigurationMode, SELF)
UNSUPPORTED(fmi3ExitConfigurationMode, SELF)
UNSUPPORTED(fmi3EvaluateDiscreteStates, SELF)
UNSUPPORTED(fmi3ActivateModelPartition, SELF, fmi3ValueReference clock, fmi3Float64 time)
