//! Turned text of pictures in pixels. The library draws turned letters without smooth edges, and therefore bolder than
//! others: they are drawn upright in a picture of their own, which is turned.

use kuva::render::render::{Primitive, Scene};

/// Takes the text that reads upwards out of a scene. It comes back upright, in a scene that is as wide as the other is high: a
/// quarter turn to the left brings it to its places.
pub(super) fn take(scene: &mut Scene) -> Option<Scene> {
    let mut turned = Scene::new(scene.height, scene.width);
    turned.text_color.clone_from(&scene.text_color);
    turned.font_family.clone_from(&scene.font_family);
    // Of nested groups, where each begins.
    let mut groups = vec![(0.0, 0.0)];
    for element in &mut scene.elements {
        match element {
            Primitive::GroupStart { transform, .. } => {
                let (x, y) = groups.last().copied().unwrap_or_default();
                let (right, down) = transform.as_deref().and_then(shift).unwrap_or_default();
                groups.push((x + right, y + down));
            }
            Primitive::GroupEnd => drop(groups.pop()),
            Primitive::Text { x, y, content, rotate: Some(angle), size, anchor, bold, color }
                if (*angle + 90.0).abs() < 1e-6 =>
            {
                let (left, top) = groups.last().copied().unwrap_or_default();
                turned.add(Primitive::Text {
                    x: scene.height - (*y + top),
                    y: *x + left,
                    content: std::mem::take(content),
                    size: *size,
                    anchor: *anchor,
                    rotate: None,
                    bold: *bold,
                    color: color.clone(),
                });
            }
            _ => {}
        }
    }
    (!turned.elements.is_empty()).then_some(turned)
}

/// The shift that a transformation `translate(x, y)` makes.
fn shift(transform: &str) -> Option<(f64, f64)> {
    let inside = transform.strip_prefix("translate(")?.strip_suffix(')')?;
    let (x, y) = inside.split_once([',', ' ']).unwrap_or((inside, "0"));
    Some((x.trim().parse().ok()?, y.trim().parse().ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;
    use kuva::render::render::TextAnchor;

    #[test]
    fn turned_text_is_taken_with_the_place_of_its_group() {
        let text = |rotate: Option<f64>| Primitive::Text {
            x: 10.0,
            y: 20.0,
            content: "a".to_owned(),
            size: 12,
            anchor: TextAnchor::Middle,
            rotate,
            bold: false,
            color: None,
        };
        let mut scene = Scene::new(300.0, 200.0);
        scene.add(text(None));
        assert!(take(&mut scene).is_none());
        scene.add(Primitive::GroupStart {
            transform: Some("translate(100,5.5)".to_owned()),
            title: None,
            extra_attrs: None,
        });
        scene.add(text(Some(-90.0)));
        let turned = take(&mut scene).unwrap();
        assert_eq!((turned.width, turned.height, turned.elements.len()), (200.0, 300.0, 1));
        let Primitive::Text { x, y, content, rotate: None, .. } = &turned.elements[0] else { panic!("text") };
        assert_eq!((*x, *y, content.as_str()), (200.0 - 25.5, 110.0, "a"));
        assert!(take(&mut scene).is_none_or(|left| {
            left.elements
                .iter()
                .all(|one| matches!(one, Primitive::Text { content, .. } if content.is_empty()))
        }));
    }
}
