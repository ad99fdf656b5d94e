//! The server of the live page.

use std::sync::{Mutex, PoisonError};

use flap_core::simulate;
use flap_live::{LiveOptions, Server, StartError};
use pyo3::exceptions::{PyOSError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::{design, error, sweep};

/// A running server; see `flapwing.Live`.
#[pyclass(frozen, module = "flapwing")]
pub(crate) struct LiveServer {
    server: Mutex<Server>,
}

#[pymethods]
impl LiveServer {
    #[new]
    #[pyo3(signature = (design, keywords, /, *, port, threads))]
    fn new(
        py: Python<'_>,
        design: &Bound<'_, PyAny>,
        keywords: &Bound<'_, PyDict>,
        port: u16,
        threads: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<LiveServer> {
        let plan = design::plan(design, Some(keywords))?;
        let options = LiveOptions { port, run: sweep::options(threads)? };
        let started = py.detach(|| Server::start(plan, simulate::all(), &options));
        let server = started.map_err(|reason| match reason {
            StartError::Port(..) => PyOSError::new_err(reason.to_string()),
            StartError::Design(mistakes) => error::grid(py, &mistakes),
            StartError::DeviceValue => {
                PyValueError::new_err(format!("{reason}\nwrite numbers in the formula"))
            }
            StartError::System(_) => PyRuntimeError::new_err(reason.to_string()),
        })?;
        Ok(LiveServer { server: Mutex::new(server) })
    }

    /// The address of the live page, with a secret token.
    #[getter]
    fn address(&self) -> String {
        self.lock().address().to_owned()
    }

    /// Stop the server of the live page.
    fn stop(&self, py: Python<'_>) {
        py.detach(|| self.lock().stop());
    }
}

impl LiveServer {
    fn lock(&self) -> std::sync::MutexGuard<'_, Server> {
        self.server.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
