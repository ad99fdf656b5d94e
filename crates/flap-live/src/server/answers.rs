//! Answers of the server: headers of answers, and HTTP statuses of refusals.

use axum::Json;
use axum::http::header::{
    CACHE_CONTROL, CONNECTION, CONTENT_SECURITY_POLICY, CONTENT_TYPE, REFERRER_POLICY, X_CONTENT_TYPE_OPTIONS,
};
use axum::http::{HeaderName, StatusCode};
use axum::response::{Html, IntoResponse, Response};
use serde_json::json;

use crate::guard::Rejection;
use crate::request::Refused;

/// The page runs only inline code, connects only to this server, and may be embedded in a notebook on this machine.
const POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data: blob:; \
                      connect-src 'self'; base-uri 'none'; form-action 'none'; \
                      frame-ancestors 'self' http://localhost:* http://127.0.0.1:* vscode-webview:";

/// Headers of every answer: browsers must not store the answer, guess its type, or pass on addresses with a
/// token.
const HEADERS: [(HeaderName, &str); 3] =
    [(CACHE_CONTROL, "no-store"), (X_CONTENT_TYPE_OPTIONS, "nosniff"), (REFERRER_POLICY, "no-referrer")];

/// Returns the page as an answer.
pub(super) fn page(page: String) -> Response {
    (HEADERS, [(CONTENT_SECURITY_POLICY, POLICY)], Html(page)).into_response()
}

/// Returns an answer from a text that is already JSON.
pub(super) fn json(text: Vec<u8>) -> Response {
    (HEADERS, [(CONTENT_TYPE, "application/json")], text).into_response()
}

/// Returns an answer with an error message.
pub(super) fn refusal(status: StatusCode, error: &str) -> Response {
    (status, HEADERS, Json(json!({ "error": error, "help": null }))).into_response()
}

/// Returns the answer to a refused request.
pub(super) fn refused(refused: Refused) -> Response {
    match refused {
        Refused::Malformed(error) => refusal(StatusCode::BAD_REQUEST, &error),
        Refused::Cancelled => refusal(StatusCode::SERVICE_UNAVAILABLE, "the request was cancelled"),
        Refused::Fault(error) => refusal(StatusCode::INTERNAL_SERVER_ERROR, &error),
        Refused::Impossible { error, help, parameter } => {
            let body = json!({ "error": error, "help": help, "parameter": parameter });
            (StatusCode::UNPROCESSABLE_ENTITY, HEADERS, Json(body)).into_response()
        }
    }
}

/// Returns the answer to a rejected request. The answer closes the connection, because other requests may wait for a
/// connection.
pub(super) fn rejected(rejection: &Rejection) -> Response {
    let answer = match rejection {
        Rejection::WrongToken => {
            let error = "the token is missing or wrong: open the address that `flap live` printed";
            refusal(StatusCode::UNAUTHORIZED, error)
        }
        Rejection::ForeignOrigin => {
            let error = "this server answers only its own page, at 127.0.0.1 or localhost and its own port";
            refusal(StatusCode::FORBIDDEN, error)
        }
    };
    ([(CONNECTION, "close")], answer).into_response()
}
