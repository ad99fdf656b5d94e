//! The routes of the server.

use std::sync::Arc;

use axum::Router;
use axum::body::{Body, to_bytes};
use axum::extract::{Path, Request, State};
use axum::http::header::CONTENT_LENGTH;
use axum::http::{HeaderMap, Method, StatusCode, Uri};
use axum::response::Response;
use axum::routing::any;
use tokio::time::timeout;

use super::answers;
use super::connections::STEP_TIMEOUT;
use super::state::{Answer, CancelOnDrop, ServerState, answer_of};
use crate::request::Refused;

/// Largest size of a request in bytes.
const MOST_BYTES: usize = 64 * 1024;

/// Returns the routes: the page and its requests.
pub(super) fn routes(state: Arc<ServerState>) -> Router {
    Router::new()
        .route("/", any(page))
        .route("/api/{kind}", any(api))
        .fallback(async || answers::refusal(StatusCode::NOT_FOUND, "there is nothing at this address"))
        .with_state(state)
}

async fn page(
    State(state): State<Arc<ServerState>>,
    method: Method,
    uri: Uri,
    headers: HeaderMap,
) -> Response {
    if let Err(rejection) = state.guard.check(&uri, &headers, true) {
        return answers::rejected(&rejection);
    }
    if method != Method::GET && method != Method::HEAD {
        return answers::refusal(StatusCode::METHOD_NOT_ALLOWED, "the page accepts only GET requests");
    }
    state.page().map_or_else(answers::refused, answers::page)
}

async fn api(State(state): State<Arc<ServerState>>, Path(kind): Path<String>, request: Request) -> Response {
    let (head, body) = request.into_parts();
    if let Err(rejection) = state.guard.check(&head.uri, &head.headers, false) {
        return answers::rejected(&rejection);
    }
    let Some(compute) = answer_of(&kind) else {
        return answers::refusal(StatusCode::NOT_FOUND, "there is no such request");
    };
    if head.method != Method::POST {
        return answers::refusal(StatusCode::METHOD_NOT_ALLOWED, "requests must use POST");
    }
    match read(&head.headers, body).await {
        Ok(body) => answer(state, compute, body).await,
        Err(refusal) => refusal,
    }
}

/// Reads the bytes of a request; returns an answer if the request is too large or incomplete.
async fn read(headers: &HeaderMap, body: Body) -> Result<Vec<u8>, Response> {
    let too_large = || answers::refusal(StatusCode::PAYLOAD_TOO_LARGE, "a request may have at most 64 KiB");
    let length = headers.get(CONTENT_LENGTH).and_then(|length| length.to_str().ok()?.parse::<usize>().ok());
    if length.is_some_and(|length| length > MOST_BYTES) {
        return Err(too_large());
    }
    match timeout(STEP_TIMEOUT, to_bytes(body, MOST_BYTES)).await {
        Ok(Ok(body)) => Ok(body.into()),
        Ok(Err(_)) => Err(too_large()),
        Err(_) => Err(answers::refusal(StatusCode::REQUEST_TIMEOUT, "the request was not completed in time")),
    }
}

/// Returns the answer to a request. The answer is computed on a separate thread, so that the server can
/// meanwhile receive requests.
async fn answer(state: Arc<ServerState>, compute: Answer, body: Vec<u8>) -> Response {
    // Dropped with this future if the page closes the connection, or if the server stops.
    let cancel = CancelOnDrop::default();
    let Ok(_permit) = state.permits.acquire().await else {
        return answers::refusal(StatusCode::SERVICE_UNAVAILABLE, "the server is shutting down");
    };
    let (worker, stop) = (Arc::clone(&state), cancel.flag());
    let worked = tokio::task::spawn_blocking(move || compute(&worker.context(&stop), &body)).await;
    let answered = worked.unwrap_or_else(|error| Err(Refused::Fault(error.to_string())));
    answered.map_or_else(answers::refused, answers::json)
}
