//! Answers of the server: their headers, and the statuses of refusals.

use axum::Json;
use axum::http::header::{
    CACHE_CONTROL, CONNECTION, CONTENT_SECURITY_POLICY, CONTENT_TYPE, REFERRER_POLICY, X_CONTENT_TYPE_OPTIONS,
};
use axum::http::{HeaderName, StatusCode};
use axum::response::{Html, IntoResponse, Response};
use serde_json::json;

use crate::guard::Rejection;
use crate::request::Refused;

/// The page runs the code in itself, asks this server alone, and may stand in a notebook of this machine.
const POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data: blob:; \
                      connect-src 'self'; base-uri 'none'; form-action 'none'; \
                      frame-ancestors 'self' http://localhost:* http://127.0.0.1:* vscode-webview:";

/// Headers of every answer: nothing of it is kept or guessed, and no address with a token is passed on.
const HEADERS: [(HeaderName, &str); 3] =
    [(CACHE_CONTROL, "no-store"), (X_CONTENT_TYPE_OPTIONS, "nosniff"), (REFERRER_POLICY, "no-referrer")];

/// The page.
pub(super) fn page(page: String) -> Response {
    (HEADERS, [(CONTENT_SECURITY_POLICY, POLICY)], Html(page)).into_response()
}

/// An answer that is JSON already.
pub(super) fn json(text: Vec<u8>) -> Response {
    (HEADERS, [(CONTENT_TYPE, "application/json")], text).into_response()
}

/// An answer that says why there is none.
pub(super) fn refusal(status: StatusCode, error: &str) -> Response {
    (status, HEADERS, Json(json!({ "error": error, "help": null }))).into_response()
}

/// The answer to a request that was refused.
pub(super) fn refused(refused: Refused) -> Response {
    match refused {
        Refused::Malformed(error) => refusal(StatusCode::BAD_REQUEST, &error),
        Refused::Superseded => refusal(StatusCode::CONFLICT, "a newer request has come"),
        Refused::Fault(error) => refusal(StatusCode::INTERNAL_SERVER_ERROR, &error),
        Refused::Impossible { error, help, parameter } => {
            let body = json!({ "error": error, "help": help, "parameter": parameter });
            (StatusCode::UNPROCESSABLE_ENTITY, HEADERS, Json(body)).into_response()
        }
    }
}

/// The answer to somebody else than the page, which ends the connection: others may wait for its place.
pub(super) fn rejected(rejection: &Rejection) -> Response {
    let answer = match rejection {
        Rejection::WrongToken => {
            let error = "the token is missing or wrong: open the address that `flap live` printed";
            refusal(StatusCode::UNAUTHORIZED, error)
        }
        Rejection::ForeignOrigin => {
            let error = "this server answers its own page alone, at 127.0.0.1 or localhost and its own port";
            refusal(StatusCode::FORBIDDEN, error)
        }
    };
    ([(CONNECTION, "close")], answer).into_response()
}
