# Forecasts of both test sets by every model, and by splines through the training runs.


rule forecast_test_set:
    input:
        model=model_files("results/models/node/{model}"),
        dataset="results/dataset/{split}.parquet",
        shapes="results/terminal_shapes/{split}.parquet",
    output:
        "results/forecasts/{model}/{split}.parquet",
    log:
        "results/logs/forecast_test_set/{model}_{split}.log",
    benchmark:
        "results/benchmarks/forecast_test_set/{model}_{split}.tsv"
    conda:
        "../../envs/learning.yaml"
    threads: 1
    resources:
        mem_mb=4000,
        runtime=10,
    params:
        code=code_of("forecast_test_set"),
        folder=lambda wildcards, input: Path(input.model[0]).parent,
    message:
        "forecast test set {wildcards.split} with {wildcards.model}"
    shell:
        "sedfiber forecast_test_set --model {params.folder} --dataset {input.dataset}"
        " --terminal-shapes {input.shapes} -o {output} > {log} 2>&1"


rule forecast_by_lookup:
    input:
        training="results/dataset/train.parquet",
        training_shapes="results/terminal_shapes/train.parquet",
        dataset="results/dataset/{split}.parquet",
        shapes="results/terminal_shapes/{split}.parquet",
    output:
        "results/forecasts/lookup/{split}.parquet",
    log:
        "results/logs/forecast_by_lookup/{split}.log",
    benchmark:
        "results/benchmarks/forecast_by_lookup/{split}.tsv"
    conda:
        "../../envs/learning.yaml"
    threads: 1
    resources:
        mem_mb=4000,
        runtime=10,
    params:
        code=code_of("forecast_by_lookup"),
    message:
        "look up test set {wildcards.split} in splines through the training runs"
    shell:
        "sedfiber forecast_by_lookup --training-dataset {input.training}"
        " --training-shapes {input.training_shapes} --dataset {input.dataset}"
        " --terminal-shapes {input.shapes} -o {output} > {log} 2>&1"


rule forecasts:
    input:
        expand("results/forecasts/{model}/{split}.parquet", model=FORECASTERS, split=TEST_SETS),
